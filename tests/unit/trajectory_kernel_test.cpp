// Trajectories (lib/trajectory.glsl) against lines in double precision.
#include "lib/trajectory.glsl"
#include "support/draw.h"

#include <gtest/gtest.h>

namespace slant {
namespace {

using test::Draw;

TEST(Trajectory, isALineThroughItsSample) {
    Draw draw;
    for (int i = 0; i < 20000; ++i) {
        const vec2 xy = draw.place(-500, 500), uv = draw.place(-1, 1), other = draw.place(-1, 1);
        const float slope = draw(-40, 40);
        const Trajectory line = trajectoryOf(xy, uv, slope);
        ASSERT_EQ(line.pinhole, pinholeOf(xy, uv, slope));
        ASSERT_EQ(line.slope, slope);
        ASSERT_EQ(seenFrom(line, vec2(0)), line.pinhole);
        // Four roundings of numbers below 1024.
        const glm::dvec2 exact = glm::dvec2(xy) + double(slope) * (glm::dvec2(other) - glm::dvec2(uv));
        const glm::dvec2 apart = glm::abs(glm::dvec2(seenFrom(line, other)) - exact);
        ASSERT_LT(std::max(apart.x, apart.y), 4 * 0x1p-15);
    }
}

/// Of a box of the lens, from its corners and places between them.
TEST(Trajectory, boundsHoldEveryMotionAndAreMet) {
    Draw draw;
    for (int i = 0; i < 2000; ++i) {
        const vec2 a = draw.place(-1, 1), b = draw.place(-1, 1);
        const vec2 low = min(a, b), high = max(a, b);
        const float s = draw(-40, 40), t = draw(-40, 40), slopeMin = min(s, t), slopeMax = max(s, t);
        const Shift shift = shiftOver(low, high, slopeMin, slopeMax);
        for (int axis = 0; axis < 2; ++axis) {
            double least = 1e9, most = -1e9;
            for (int corner = 0; corner < 4; ++corner) {
                const double at =
                    double(corner & 1 ? high[axis] : low[axis]) * double(corner & 2 ? slopeMax : slopeMin);
                least = std::min(least, at), most = std::max(most, at);
            }
            ASSERT_NEAR(shift.low[axis], least, 1e-5);
            ASSERT_NEAR(shift.high[axis], most, 1e-5);
            for (int k = 0; k < 50; ++k) {
                const double u = double(low[axis]) + draw.part() * double(high[axis] - low[axis]);
                const double slope = double(slopeMin) + draw.part() * double(slopeMax - slopeMin);
                ASSERT_GE(slope * u, double(shift.low[axis]) - 1e-5);
                ASSERT_LE(slope * u, double(shift.high[axis]) + 1e-5);
            }
        }
        const Shift here = shiftAt(a, slopeMin, slopeMax), same = shiftOver(a, a, slopeMin, slopeMax);
        ASSERT_EQ(here.low, same.low);
        ASSERT_EQ(here.high, same.high);
    }
}

TEST(Trajectory, boundsAroundTheFocusHoldBothSides) {
    const Shift shift = shiftOver(vec2(-0.5f, 0.25f), vec2(1, 0.5f), -2, 4);
    EXPECT_EQ(shift.low, vec2(-2, -1));
    EXPECT_EQ(shift.high, vec2(4, 2));
    const Shift at = shiftAt(vec2(-0.5f, 0.25f), -2, 4);
    EXPECT_EQ(at.low, vec2(-2, -0.5f));
    EXPECT_EQ(at.high, vec2(1, 1));
}

} // namespace
} // namespace slant

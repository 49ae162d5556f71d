// The part of the lens from which samples are visible, in a case where it is known: behind the edge of a half
// plane.
#include "reconstruct/occlusion.h"
#include "support/synthetic.h"

#include <cmath>
#include <gtest/gtest.h>

namespace slant {
namespace {

const Rect kFrame{0, 0, 96, 72};
constexpr float kEdge = 48, kFront = -6, kBack = 6;

/// A half plane in front, x < kEdge, and a plane behind it.
LightField halfPlaneBeforePlane(int spp) {
    const auto grey = [](vec2) { return vec3(0.5f); };
    return synthetic::sample(
        {{kFront, [](vec2 p) { return p.x < kEdge; }, grey}, {kBack, [](vec2) { return true; }, grey}},
        kFrame, 15, spp, 3);
}

/// Part of the unit disc with u > cut.
double discBeyond(double cut) {
    if (cut >= 1) return 0;
    if (cut <= -1) return 1;
    return (std::acos(cut) - cut * std::sqrt(1 - cut * cut)) / M_PI;
}

class Occlusion : public testing::TestWithParam<int> {};

TEST_P(Occlusion, partOfTheLensBehindAnEdge) {
    const LightField field = halfPlaneBeforePlane(GetParam());
    MotionGrid still;
    const GridLayout grid = chooseGrid(SceneSideSamples(field), densityOf(SceneSideSamples(field)), {kFrame});
    const OcclusionLayout layout = chooseOcclusion(grid, densityOf(SceneSideSamples(field)), still);
    const std::vector<uint> stopped = countStopped(SceneSideSamples(field), grid, layout, still);
    // A ray to p on the plane behind passes the front at p + (kBack - kFront) u.
    for (float x = 36.5f; x < 60; x += 1) {
        double mean = 0;
        for (int y = 8; y < 64; ++y)
            mean += 1 / visibilityWeight(stopped, grid, layout, vec2(x, y), kBack, 1) / 56;
        // Blocks are 4 px wide and planes up to a pixel from the sample's own slope.
        const double nearer = discBeyond((kEdge - x + 4.5) / (kBack - kFront)),
                     further = discBeyond((kEdge - x - 4.5) / (kBack - kFront));
        EXPECT_GT(mean, std::max<double>(nearer, kMinVisible) - 0.03) << x;
        EXPECT_LT(mean, std::max<double>(further, kMinVisible) + 0.03) << x;
    }
}

TEST_P(Occlusion, nothingHidesTheFront) {
    const LightField field = halfPlaneBeforePlane(GetParam());
    MotionGrid still;
    const GridLayout grid = chooseGrid(SceneSideSamples(field), densityOf(SceneSideSamples(field)), {kFrame});
    const OcclusionLayout layout = chooseOcclusion(grid, densityOf(SceneSideSamples(field)), still);
    const std::vector<uint> stopped = countStopped(SceneSideSamples(field), grid, layout, still);
    for (float x = 0; x < 48; x += 1)
        EXPECT_EQ(visibilityWeight(stopped, grid, layout, vec2(x, 30), kFront, 1), 1);
}

/// A picture of any size and blur has no more blocks than a device's buffer can hold.
TEST(OcclusionLayout, blocksStayBounded) {
    GridLayout grid{};
    grid.brickCount = ivec2(4000, 3000);
    grid.cellsPerBrick = 8;
    grid.invCell = 1;
    grid.bucketCount = 4000;
    grid.invBucket = 2;
    grid.surfaceGap = 0.5f;
    SampleDensity density;
    density.least = density.typical = 8;
    MotionGrid still;
    const OcclusionLayout layout = chooseOcclusion(grid, density, still);
    EXPECT_LE(stoppedBlocks(layout, still), std::size_t(1) << 25);
    const vec2 covered = vec2(layout.blockCount) / layout.invBlock;
    EXPECT_GE(covered.x, 32000);
    EXPECT_GE(covered.y, 24000);
    EXPECT_NEAR(layout.raysPerBlock, 8 / (layout.invBlock * layout.invBlock), 1);
}

INSTANTIATE_TEST_SUITE_P(Spp, Occlusion, testing::Values(1, 4, 16));

} // namespace
} // namespace slant

// Where outputs lie: strata of pixel, lens and time, and the map onto the lens.
#include "reconstruct/output_pattern.h"

#include "camera/disc.h"
#include "lib/disc.glsl"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <set>

namespace slant {
namespace {

/// The concentric map in double precision, from [-1, 1]^2.
glm::dvec2 exactDisc(glm::dvec2 square) {
    const bool wide = std::abs(square.x) > std::abs(square.y);
    const double r = wide ? square.x : square.y;
    if (r == 0) return {0, 0};
    const double angle = std::numbers::pi / 4 * (wide ? square.y : square.x) / r;
    return wide ? glm::dvec2(r * std::cos(angle), r * std::sin(angle))
                : glm::dvec2(r * std::sin(angle), r * std::cos(angle));
}

/// Its inverse.
glm::dvec2 exactSquare(glm::dvec2 disc) {
    const bool wide = std::abs(disc.x) > std::abs(disc.y);
    const double r = std::copysign(std::hypot(disc.x, disc.y), wide ? disc.x : disc.y);
    const double across =
        r * std::atan((wide ? disc.y : disc.x) / (wide ? disc.x : disc.y)) * 4 / std::numbers::pi;
    return wide ? glm::dvec2(r, across) : glm::dvec2(across, r);
}

std::vector<Output> outputsOf(const OutputPattern& pattern, ivec2 pixel, uint seed = 0) {
    std::vector<Output> outputs;
    for (int i = 0; i < pattern.outputsPerPixel(); ++i) outputs.push_back(outputAt(pixel, i, pattern, seed));
    return outputs;
}

/// Each of `count` equal parts of [0, 1) holds one value.
void expectOneInEach(const std::vector<double>& values) {
    std::set<int> strata;
    for (const double value : values) {
        ASSERT_GE(value, 0);
        ASSERT_LT(value, 1);
        strata.insert(int(value * double(values.size())));
    }
    EXPECT_EQ(strata.size(), values.size());
}

const std::vector<ivec2> kPixels = {{0, 0}, {1, 0}, {0, 1}, {-3, 17}, {4000, 2000}};

TEST(OutputPattern, everyLensCellIsHitOnceInEveryPixel) {
    for (const int count : {1, 2, 4, 8, 32, 128, 1024}) {
        const OutputPattern pattern = makeOutputPattern(count, 5);
        ASSERT_EQ(pattern.lensCells.x * pattern.lensCells.y, count);
        for (const ivec2 pixel : kPixels) {
            std::set<std::pair<int, int>> cells;
            const std::vector<Output> outputs = outputsOf(pattern, pixel);
            for (int i = 0; i < count; ++i) {
                const glm::dvec2 cell(lensCell(pattern.entries[std::size_t(i)]));
                const glm::dvec2 inside =
                    (exactSquare(outputs[std::size_t(i)].uv) + 1.0) / 2.0 * glm::dvec2(pattern.lensCells) -
                    cell;
                ASSERT_TRUE(inside.x > -1e-4 && inside.x < 1.0001 && inside.y > -1e-4 && inside.y < 1.0001)
                    << count << ", output " << i;
                cells.emplace(int(cell.x), int(cell.y));
            }
            EXPECT_EQ(cells.size(), std::size_t(count));
            EXPECT_LT(cells.rbegin()->first, pattern.lensCells.x);
        }
    }
}

TEST(OutputPattern, positionAndTimeAreStratified) {
    for (const int count : {1, 2, 16, 128, 1024}) {
        const OutputPattern pattern = makeOutputPattern(count, 5);
        for (const ivec2 pixel : kPixels) {
            std::vector<double> xs, ys, ts;
            for (const Output& o : outputsOf(pattern, pixel)) {
                const int code = int(o.positionCode);
                xs.push_back(double(code / kSubpixels) / kSubpixels);
                ys.push_back(double(code % kSubpixels) / kSubpixels);
                ts.push_back(o.t);
                EXPECT_NEAR(o.xy.x, pixel.x + xs.back(), 5e-4);
                EXPECT_NEAR(o.xy.y, pixel.y + ys.back(), 5e-4);
            }
            expectOneInEach(xs);
            expectOneInEach(ys);
            expectOneInEach(ts);
        }
    }
}

/// Where blur is small, only the first outputs of each group are made.
TEST(OutputPattern, theFirstOfAllGroupsAreStratifiedToo) {
    for (const int count : {8, 64, 128, 1024}) {
        const OutputPattern pattern = makeOutputPattern(count, 5);
        ASSERT_GT(pattern.groupBits, 0);
        for (int bits = 0; bits <= pattern.groupBits; ++bits) {
            std::vector<double> x, y, t;
            std::set<int> taken;
            for (int first = 0; first < count; first += pattern.groupSize())
                for (int rank = 0; rank < 1 << bits; ++rank) {
                    const int member = inOrder(pattern.entries[std::size_t(first + rank)]);
                    ASSERT_LT(member, pattern.groupSize());
                    taken.insert(first + member);
                    const Output o = outputAt({3, 5}, first + member, pattern, 1);
                    x.push_back(o.xy.x - 3);
                    y.push_back(o.xy.y - 5);
                    t.push_back(o.t);
                }
            EXPECT_EQ(taken.size(), x.size()) << "each once";
            for (const std::vector<double>& values : {x, y, t}) expectOneInEach(values);
        }
    }
    EXPECT_EQ(makeOutputPattern(32, 5).sparseBits, makeOutputPattern(32, 5).groupBits);
    EXPECT_EQ(makeOutputPattern(128, 5).groups.size() << makeOutputPattern(128, 5).sparseBits, 32u);
}

TEST(OutputPattern, pixelsAndSeedsDiffer) {
    const OutputPattern pattern = makeOutputPattern(16, 5);
    std::set<std::vector<float>> codes, lenses;
    for (const ivec2 pixel : kPixels)
        for (const uint seed : {0u, 1u, 0xffffffffu}) {
            std::vector<float> code, lens;
            for (const Output& o : outputsOf(pattern, pixel, seed)) {
                code.push_back(o.positionCode);
                lens.push_back(o.uv.x);
            }
            codes.insert(code);
            lenses.insert(lens);
        }
    EXPECT_EQ(codes.size(), 3 * kPixels.size());
    EXPECT_EQ(lenses.size(), 3 * kPixels.size());
}

TEST(OutputPattern, groupsHoldTheirOutputs) {
    for (const int count : {1, 4, 8, 64, 512})
        for (const float slopePx : {0.f, 3.f, 30.f, 1e4f, 1e30f}) {
            const float lensScale = slopePx == 3.f ? 0.3f : slopePx == 30.f ? 0.f : 1.f;
            const OutputPattern pattern = makeOutputPattern(count, slopePx, lensScale);
            ASSERT_EQ(int(pattern.groups.size()) * pattern.groupSize(), count);
            for (int x = 0; x < 50; ++x) {
                const std::vector<Output> outputs = outputsOf(pattern, {x, 3 * x});
                for (std::size_t i = 0; i < outputs.size(); ++i) {
                    const LensBox& box = pattern.groups[i / std::size_t(pattern.groupSize())];
                    EXPECT_TRUE(glm::all(glm::greaterThanEqual(outputs[i].uv, box.min)) &&
                                glm::all(glm::lessThanEqual(outputs[i].uv, box.max)));
                }
            }
        }
}

TEST(OutputPattern, groupsHoldTheirOutputsWhateverTheAperture) {
    for (const char* shape : {"disc", "gaussian", "star", "polygon 5 7"})
        for (const int count : {1, 64, 512}) {
            const OutputPattern pattern =
                makeOutputPattern(count, 30, 0.7f, Aperture(*parseAperture(shape, {})));
            for (int x = 0; x < 50; ++x) {
                const std::vector<Output> outputs = outputsOf(pattern, {x, 3 * x});
                for (std::size_t i = 0; i < outputs.size(); ++i) {
                    const LensBox& box = pattern.groups[i / std::size_t(pattern.groupSize())];
                    EXPECT_TRUE(glm::all(glm::greaterThanEqual(outputs[i].uv, box.min)) &&
                                glm::all(glm::lessThanEqual(outputs[i].uv, box.max)))
                        << shape;
                }
            }
        }
}

TEST(ConcentricDisc, isExactToAFewUlp) {
    constexpr int kSteps = 400;
    const double ulp = 0x1p-23;
    for (int j = 0; j <= kSteps; ++j)
        for (int i = 0; i <= kSteps; ++i) {
            const vec2 square(2 * float(i) / kSteps - 1, 2 * float(j) / kSteps - 1);
            const glm::dvec2 exact = exactDisc(square);
            const double radius = std::max(std::abs(square.x), std::abs(square.y));
            const vec2 ofOutputs = concentricDisc(square);
            ASSERT_LE(glm::length(glm::dvec2(ofOutputs) - exact), 2 * ulp * radius) << i << ' ' << j;
            const glm::vec2 ofCamera = concentricDisc(float(i) / kSteps, float(j) / kSteps);
            ASSERT_LE(glm::length(glm::dvec2(ofCamera) - exact), 4 * ulp * std::max(radius, 0.01))
                << i << ' ' << j;
            ASSERT_LE(glm::length(glm::dvec2(ofCamera)), 1);
        }
}

} // namespace
} // namespace slant

#include "trace/pattern.h"

#include "base/error.h"
#include "camera/disc.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <set>
#include <vector>

namespace slant {
namespace {

/// Samples of the pixels [x0, x0 + size)^2, (y likewise), as raster positions relative to x0, y0.
struct PlacedPoint {
    glm::vec2 raster, lens;
};

std::vector<PlacedPoint> place(const Pattern& pattern, int x0, int y0, int size) {
    std::vector<PlacedPoint> points;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
            for (int s = 0; s < pattern.samplesPerPixel(); ++s) {
                PatternPoint p = pattern.point(pattern.pixel(x0 + x, y0 + y), s);
                points.push_back({{float(x) + p.x, float(y) + p.y}, concentricDisc(p.a, p.b)});
            }
    return points;
}

/// Radius of the largest empty circle with its centre in [margin, size - margin)^2, found on a fine grid.
double largestEmptyCircle(const std::vector<glm::vec2>& points, double size, double margin, int spp) {
    const double cell = 1 / std::sqrt(double(spp));
    const int n = int(size / cell) + 1;
    std::vector<std::vector<glm::vec2>> grid(std::size_t(n) * std::size_t(n));
    for (glm::vec2 p : points)
        if (p.x >= 0 && p.y >= 0 && p.x < float(size) && p.y < float(size))
            grid[std::size_t(int(p.y / cell) * n + int(p.x / cell))].push_back(p);
    double largest = 0;
    for (double y = margin; y < size - margin; y += cell / 4)
        for (double x = margin; x < size - margin; x += cell / 4) {
            double nearest = 1e9;
            for (int reach = 1; nearest > (reach - 1) * cell; ++reach)
                for (int j = std::max(0, int(y / cell) - reach); j <= std::min(n - 1, int(y / cell) + reach);
                     ++j)
                    for (int i = std::max(0, int(x / cell) - reach);
                         i <= std::min(n - 1, int(x / cell) + reach); ++i)
                        for (glm::vec2 p : grid[std::size_t(j * n + i)])
                            nearest = std::min(nearest, std::hypot(p.x - x, p.y - y));
            largest = std::max(largest, nearest);
        }
    return largest;
}

TEST(Pattern, pixelAndLensAreStratifiedForPowersOfTwo) {
    for (int spp : {2, 4, 16, 64, 256})
        for (auto [x, y] : {std::pair(0, 0), {17, 300}, {-5, -129}}) {
            Pattern pattern(spp, 42);
            int bits = int(std::lround(std::log2(spp)));
            for (int first = 0; first <= bits; ++first) { // every elementary interval holds one point
                int columns = 1 << first, rows = 1 << (bits - first);
                std::set<int> pixelCells, lensCells, times;
                for (int s = 0; s < spp; ++s) {
                    PatternPoint p = pattern.point(pattern.pixel(x, y), s);
                    pixelCells.insert(int(p.x * float(columns)) * rows + int(p.y * float(rows)));
                    lensCells.insert(int(p.a * float(columns)) * rows + int(p.b * float(rows)));
                    times.insert(int(p.t * float(spp)));
                }
                EXPECT_EQ(int(pixelCells.size()), spp);
                EXPECT_EQ(int(lensCells.size()), spp);
                EXPECT_EQ(int(times.size()), spp);
            }
        }
}

TEST(Pattern, neighbouringPixelsComplementEachOther) {
    // Four pixels of an aligned block with spp samples each stratify the lens as 4 spp samples do.
    Pattern pattern(4, 7);
    for (int block = 0; block < 50; ++block) {
        std::set<int> cells;
        for (int pixel = 0; pixel < 4; ++pixel)
            for (int s = 0; s < 4; ++s) {
                PatternPoint p =
                    pattern.point(pattern.pixel(2 * block - 40 + pixel % 2, 2 * block + pixel / 2), s);
                cells.insert(int(p.a * 4) * 4 + int(p.b * 4));
            }
        EXPECT_EQ(cells.size(), 16u);
    }
}

TEST(Pattern, leavesNoHoles) {
    // Radii of the largest empty circle, 2 / sqrt(spp) and less.
    const std::pair<int, double> bars[] = {{1, 2.0}, {2, 1.34}, {3, 1.15}, {4, 1.10}, {5, .89},
                                           {8, .80}, {12, .58}, {16, .50}, {32, .37}, {64, .27}};
    for (auto [spp, bar] : bars) {
        const int size = spp > 16 ? 20 : 40;
        Pattern pattern(spp, 3);
        std::vector<PlacedPoint> placed =
            place(pattern, 128 - size / 2, -size / 2, size); // over a tile's corner
        std::vector<glm::vec2> points;
        for (const PlacedPoint& p : placed) points.push_back(p.raster);
        EXPECT_LT(largestEmptyCircle(points, size, 2, spp), bar) << spp;
    }
}

TEST(Pattern, leavesNoHolesAfterShearing) {
    // Seen from one lens position the samples are at least as even as random ones: 1.15 x 2 / sqrt(spp).
    for (int spp : {1, 3, 8})
        for (float slope : {1.f, 7.f, 30.f}) {
            const int size = int(2 * slope) + 24;
            Pattern pattern(spp, 3);
            std::vector<glm::vec2> points;
            for (const PlacedPoint& p : place(pattern, 5, 9, size))
                points.push_back(p.raster - slope * p.lens);
            EXPECT_LT(largestEmptyCircle(points, size, slope + 2, spp), 1.15 * 2 / std::sqrt(double(spp)))
                << spp << " " << slope;
        }
}

TEST(Pattern, convergesFasterThanRandomOnABlurredEdge) {
    // Coverage of pixels by a defocused edge; random samples would err by 0.48 / sqrt(spp).
    for (auto [spp, bar] : {std::pair(4, 0.31), {7, 0.30}, {16, 0.25}, {64, 0.2}}) {
        Pattern pattern(spp, 1);
        double squares = 0;
        int count = 0;
        for (int orientation = 0; orientation < 7; ++orientation) {
            float c = std::cos(0.9f * float(orientation)), s = std::sin(0.9f * float(orientation)), slope = 4;
            for (int y = 0; y < 20; ++y)
                for (int x = 0; x < 20; ++x) {
                    int covered = 0;
                    for (int k = 0; k < spp; ++k) {
                        PatternPoint p = pattern.point(pattern.pixel(x, y), k);
                        glm::vec2 lens = concentricDisc(p.a, p.b);
                        covered += c * (p.x - 0.5f - slope * lens.x) + s * (p.y - 0.5f - slope * lens.y) > 0;
                    }
                    squares += std::pow(double(covered) / spp - 0.5, 2);
                    ++count;
                }
        }
        EXPECT_LT(std::sqrt(squares / count), bar / std::sqrt(double(spp))) << spp;
    }
}

TEST(Pattern, eachShadingDimensionIsUniformAndItsOwn) {
    Pattern pattern(16, 5);
    double sums[6] = {}, products[6] = {};
    const int count = 64 * 64 * 16;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x)
            for (int s = 0; s < 16; ++s) {
                ShadingSampler sampler = pattern.shading(pattern.pixel(x, y), s);
                glm::vec2 a = sampler.next2D(), b = sampler.next2D();
                float values[6] = {
                    a.x, a.y, b.x, b.y, sampler.next1D(), pattern.point(pattern.pixel(x, y), s).x};
                for (int i = 0; i < 6; ++i) {
                    ASSERT_GE(values[i], 0);
                    ASSERT_LT(values[i], 1);
                    sums[i] += values[i];
                    products[i] += (values[i] - 0.5) * (values[(i + 1) % 6] - 0.5);
                }
            }
    for (int i = 0; i < 6; ++i) {
        EXPECT_NEAR(sums[i] / count, 0.5, 1e-3);
        EXPECT_NEAR(12 * products[i] / count, 0, 0.02);
    }
}

TEST(Pattern, seedsGiveOtherPatternsAndTheSameSeedTheSame) {
    Pattern a(4, 1), b(4, 2), c(4, 1ull << 40), again(4, 1);
    int equal = 0;
    for (int x = 0; x < 100; ++x) {
        PatternPoint p = a.point(a.pixel(x, 3), 2), q = b.point(b.pixel(x, 3), 2),
                     r = c.point(c.pixel(x, 3), 2);
        equal += (p.x == q.x) + (p.x == r.x) + (q.a == r.a);
        EXPECT_EQ(p.b, again.point(again.pixel(x, 3), 2).b);
    }
    EXPECT_LE(equal, 1);
}

TEST(Pattern, refusesCountsOutOfRange) {
    for (int spp : {0, -1, Pattern::kMaxSamplesPerPixel + 1}) EXPECT_THROW(Pattern(spp, 0), Error) << spp;
    EXPECT_NO_THROW(Pattern(Pattern::kMaxSamplesPerPixel, 0));
}

} // namespace
} // namespace slant

// The weight of a sample: the density around it (lib/density.glsl) and the part of the lens from which it is
// visible (lib/occlusion.glsl), counted over all pixels and all rays in double precision.
#include "reconstruct/bins.h"
#include "reconstruct/kernels.h"
#include "reconstruct/occlusion.h"
#include "support/synthetic.h"

#include <cmath>
#include <gtest/gtest.h>

namespace slant {
namespace {

const Rect kFrame{0, 0, 44, 36};

LightField varying(const synthetic::Counts& counts) {
    return synthetic::sample(synthetic::discsOverChecks(), kFrame, 15, counts.at, 3);
}

/// Samples per pixel over the pixels in a square of the blur's area, at least 3 x 3; pixels at the rim stand
/// for those beyond. `nearTie`: rounding decides in which pixels its sides lie.
double meanCount(const LightField& field, glm::dvec2 p, double slope, bool& nearTie) {
    const double half = std::max(std::sqrt(M_PI) / 2 * std::abs(slope), 1.5);
    ivec2 low, high;
    const ivec2 origin(field.bounds.x0, field.bounds.y0), size(field.bounds.width(), field.bounds.height());
    for (int axis = 0; axis < 2; ++axis) {
        const double from = p[axis] - half - origin[axis] + 0.5, to = p[axis] + half - origin[axis] + 0.5;
        for (const double side : {from, to}) nearTie |= std::abs(side - std::round(side)) < 1e-4;
        low[axis] = int(std::clamp(std::floor(from), 0.0, size[axis] - 1.0));
        high[axis] = int(std::clamp(std::floor(to), low[axis] + 1.0, double(size[axis])));
    }
    double sum = 0;
    for (int y = low.y; y < high.y; ++y)
        for (int x = low.x; x < high.x; ++x)
            sum += double(field.samplesOf(std::size_t(y) * std::size_t(size.x) + std::size_t(x)));
    return std::max(sum / (double(high.x - low.x) * (high.y - low.y)), 1.0 / 64);
}

TEST(DensityKernel, isTheMeanOfAllPixelsInTheSquareOfTheBlur) {
    for (const synthetic::Counts& counts : synthetic::varyingCounts(kFrame)) {
        const LightField field = varying(counts);
        const SampleDensity density = densityOf(SceneSideSamples(field));
        synthetic::Random random(41);
        double least = 1e9;
        for (int i = 0; i < 4000; ++i) {
            const vec2 p(-30 + 104 * random.uniform(), -30 + 96 * random.uniform());
            const float slope = 30 * (random.uniform() - 0.5f);
            bool nearTie = false;
            const double expected = meanCount(field, p, double(slope), nearTie);
            if (nearTie) continue;
            ASSERT_NEAR(samplesAround(density, p, slope), expected, 1e-5 * expected) << counts.name;
            const double ratio = std::max(std::sqrt(expected) * 0.6 / double(kSearchRadius), 1.0);
            ASSERT_NEAR(radiusRatioAt(density, p, slope, 0.6f), ratio, 1e-5 * ratio) << counts.name;
            least = std::min(least, expected);
        }
        EXPECT_LT(least, density.typical) << counts.name;
    }
}

/// For each plane and block, the followed rays that end before they reach it.
std::vector<uint> stoppedBefore(const LightField& field, const GridLayout& grid,
                                const OcclusionLayout& layout) {
    std::vector<uint> stopped(stoppedBlocks(layout, {}));
    for (int plane = 0; plane < layout.planeCount; ++plane) {
        const double begin = double(layout.slopeMin) + plane * double(layout.spacing);
        const double slope = begin + double(layout.spacing) / 2;
        for (const LightFieldSample& s : field.samples) {
            if (!isFollowed(layout, vec2(s.x, s.y)) || !std::isfinite(s.slope)) continue;
            if (double(s.slope) + double(grid.surfaceGap) >= begin) continue;
            const glm::dvec2 p = glm::dvec2(s.x, s.y) - slope * glm::dvec2(s.u, s.v);
            const ivec2 block(floor((p - glm::dvec2(grid.origin)) * double(layout.invBlock)));
            if (block.x < 0 || block.y < 0 || block.x >= layout.blockCount.x ||
                block.y >= layout.blockCount.y)
                continue;
            ++stopped[(std::size_t(plane) * std::size_t(layout.blockCount.y) + std::size_t(block.y)) *
                          std::size_t(layout.blockCount.x) +
                      std::size_t(block.x)];
        }
    }
    return stopped;
}

std::vector<LightField> fields() {
    std::vector<LightField> made;
    for (const int spp : {1, 4, 16, 40})
        made.push_back(synthetic::sample(synthetic::discsOverChecks(), kFrame, 15, spp, 3));
    for (const synthetic::Counts& counts : synthetic::varyingCounts(kFrame)) made.push_back(varying(counts));
    synthetic::Random random(11); // any slopes, not those of three layers
    for (LightField& field : made)
        for (LightFieldSample& s : field.samples) s.slope += 3 * (random.uniform() - 0.5f);
    return made;
}

TEST(OcclusionKernel, countsTheRaysThatEndBeforeABlock) {
    for (const LightField& field : fields()) {
        const SampleDensity density = densityOf(SceneSideSamples(field));
        const GridLayout grid = chooseGrid(SceneSideSamples(field), density, {kFrame});
        MotionGrid still;
        const OcclusionLayout layout = chooseOcclusion(grid, density, still);
        const std::vector<uint> got = countStopped(SceneSideSamples(field), grid, layout, still);
        const std::vector<uint> expected = stoppedBefore(field, grid, layout);
        ASSERT_EQ(got.size(), expected.size());
        double rays = 0, apart = 0;
        for (std::size_t i = 0; i < got.size(); ++i) {
            rays += expected[i];
            apart += std::abs(double(got[i]) - double(expected[i]));
        }
        EXPECT_GT(rays, 1000);
        EXPECT_LE(apart, rays * 2e-4) << "at the sides of blocks, by rounding";

        std::size_t followed = 0;
        for (const LightFieldSample& s : field.samples) followed += isFollowed(layout, vec2(s.x, s.y));
        EXPECT_NEAR(double(followed) * layout.stride / double(field.samples.size()), 1, 0.05);
    }
}

/// 1 / (part of the rays that are not stopped before the sample's plane and block), down to a sixteenth.
TEST(OcclusionKernel, weightsOfBinsAreTheRaysThatAreLeft) {
    for (const LightField& field : fields()) {
        const SceneSideSamples source(field);
        const SampleDensity density = densityOf(source);
        const Bins bins = binSamples(source, {kFrame});
        MotionGrid still;
        const OcclusionLayout layout = chooseOcclusion(bins.grid, density, still);
        const std::vector<uint> stopped = stoppedBefore(field, bins.grid, layout);
        std::size_t different = 0, hidden = 0;
        for (std::size_t record = 0; record < bins.samples.size(); ++record) {
            const LightFieldSample& s = field.samples[bins.samples[record]];
            const glm::dvec2 p = glm::dvec2(s.x, s.y) - double(s.slope) * glm::dvec2(s.u, s.v);
            const glm::dvec2 place = floor((p - glm::dvec2(bins.grid.origin)) * double(layout.invBlock));
            const ivec2 block(clamp(place, glm::dvec2(0), glm::dvec2(layout.blockCount - 1)));
            const int plane = std::clamp(
                int(std::floor((double(s.slope) - double(layout.slopeMin)) / double(layout.spacing))), 0,
                layout.planeCount - 1);
            const double density2 = double(bins.values[record].w) * double(bins.values[record].w);
            const double rays = double(density.least) / layout.stride * density2 /
                                (double(layout.invBlock) * double(layout.invBlock));
            const double ended =
                stopped[(std::size_t(plane) * std::size_t(layout.blockCount.y) + std::size_t(block.y)) *
                            std::size_t(layout.blockCount.x) +
                        std::size_t(block.x)];
            const double weight = 1 / std::max(1 - ended / rays, 1.0 / 16);
            different += std::abs(double(bins.positions[record].w) - weight) > 1e-4 * weight;
            hidden += weight > 1.1;
        }
        EXPECT_LE(different, bins.samples.size() / 50) << "a ray more or less in a block, by rounding";
        EXPECT_GT(hidden, bins.samples.size() / 20);
    }
}

} // namespace
} // namespace slant

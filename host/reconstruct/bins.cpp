#include "reconstruct/bins.h"

#include "base/parallel.h"
#include "base/sort.h"
#include "reconstruct/kernels.h"
#include "reconstruct/occlusion.h"

#include <algorithm>

namespace slant {
namespace {

/// Binned samples sorted by key, those of equal keys by index.
struct Order {
    std::vector<uint> keys, samples;
};

Order sortedSamples(std::span<const LightFieldSample> samples, const Rect& region, float marginPx,
                    const GridLayout& grid) {
    Order order{std::vector<uint>(samples.size()), std::vector<uint>(samples.size())};
    parallelFor(0, samples.size(), 1 << 14, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const LightFieldSample& s = samples[i];
            order.keys[i] =
                reaches(s, region, marginPx) ? sortKey(grid, pinholePosition(s), s.slope) : kNotBinned;
            order.samples[i] = uint(i);
        }
    });
    radixSort(order.keys, order.samples, 32);
    order.keys.resize(grid.sampleCount);
    order.samples.resize(grid.sampleCount);
    return order;
}

/// Bounds of a brick while its samples are gathered.
struct BrickBounds {
    uint key = kNotBinned; ///< of the brick
    ivec2 first{255}, last{0};
    float slopeMin = 0, slopeMax = 0, radiusRatio = 0;

    BrickBounds(uint brickKey, float slope, float ownRatio)
        : key(brickKey), slopeMin(slope), slopeMax(slope), radiusRatio(ownRatio) {}

    void add(ivec2 cell, float slope, float ownRatio) {
        first = glm::min(first, cell);
        last = glm::max(last, cell);
        slopeMin = std::min(slopeMin, slope);
        slopeMax = std::max(slopeMax, slope);
        radiusRatio = std::min(radiusRatio, ownRatio);
    }

    Brick brick(const GridLayout& grid) const {
        const ivec2 place(int(key) % grid.brickCount.x, int(key) / grid.brickCount.x % grid.brickCount.y);
        const ivec2 corner = place * grid.cellsPerBrick;
        const uvec2 extent = brickExtent(uvec2(corner + first), uvec2(corner + last), radiusRatio);
        return {extent.x, extent.y, slopeMin, slopeMax};
    }
};

} // namespace

Bins binSamples(const SceneSideSamples& source, const BinScope& scope) {
    const SampleDensity density = densityOf(source);
    const std::span<const LightFieldSample> samples = source.samples();
    Bins bins;
    bins.grid = chooseGrid(samples, density, scope);
    const uint cellsPerBrick = uint(bins.grid.cellsPerBrick) * uint(bins.grid.cellsPerBrick);
    Order order = sortedSamples(samples, scope.region, marginPx(scope, density), bins.grid);
    const std::size_t count = order.keys.size();

    const OcclusionLayout occlusion = chooseOcclusion(bins.grid, density);
    const std::vector<uint> stopped = countStopped(samples, bins.grid, occlusion);

    bins.positions.reserve(count);
    bins.values.reserve(count);
    std::vector<BrickBounds> bricks;
    for (std::size_t record = 0; record < count; ++record) {
        const uint key = order.keys[record], cell = key % cellsPerBrick;
        const uint sample = order.samples[record];
        const LightFieldSample& s = samples[sample];
        const vec2 p = pinholePosition(s);
        const float radiusRatio = radiusRatioAt(density, p, s.slope, bins.grid.radiusPx);
        if (bricks.empty() || key / cellsPerBrick != bricks.back().key)
            bricks.emplace_back(key / cellsPerBrick, s.slope, radiusRatio);
        bricks.back().add(ivec2(int(cell) % bins.grid.cellsPerBrick, int(cell) / bins.grid.cellsPerBrick),
                          s.slope, radiusRatio);
        // Cells up to this one begin here at the latest.
        bins.cellStart.resize((bricks.size() - 1) * cellsPerBrick + cell + 1, uint(record));
        const float excess = source.areaExcess().empty() ? 0.f : source.areaExcess()[sample];
        bins.positions.emplace_back(p, s.slope,
                                    visibilityWeight(stopped, bins.grid, occlusion, p, s.slope,
                                                     radiusRatio / glm::sqrt(1.f + excess)));
        bins.values.emplace_back(0, 0, 0, radiusRatio);
    }
    for (const BrickBounds& bounds : bricks) bins.bricks.push_back(bounds.brick(bins.grid));
    bins.cellStart.resize(bins.bricks.size() * cellsPerBrick + 1, uint(count));
    bins.samples = std::move(order.samples);
    return bins;
}

void takeValues(Bins& bins, const SceneSideSamples& samples, ValuePlane plane) {
    parallelFor(0, bins.values.size(), 1 << 15, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            bins.values[i] = vec4(samples.value(plane, bins.samples[i]), bins.values[i].w);
    });
}

} // namespace slant

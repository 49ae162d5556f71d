#include "reconstruct/bins.h"

#include "base/parallel.h"
#include "base/sort.h"
#include "reconstruct/kernels.h"
#include "reconstruct/occlusion.h"

#include <algorithm>

namespace slant {
namespace {

/// Binned samples by key, and those of one key by index.
struct Order {
    std::vector<uint> keys, samples;
};

Order sortedSamples(const LightField& field, const Rect& region, float marginPx, const GridLayout& grid) {
    Order order{std::vector<uint>(field.samples.size()), std::vector<uint>(field.samples.size())};
    parallelFor(0, field.samples.size(), 1 << 14, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const LightFieldSample& s = field.samples[i];
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

/// Bounds of a brick while its samples come in.
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

Bins binSamples(const LightField& field, const BinScope& scope) {
    const SampleDensity density = densityOf(field);
    Bins bins;
    bins.grid = chooseGrid(field, density, scope);
    const uint cellsPerBrick = uint(bins.grid.cellsPerBrick) * uint(bins.grid.cellsPerBrick);
    Order order = sortedSamples(field, scope.region, marginPx(scope, density), bins.grid);
    const std::size_t count = order.keys.size();

    const OcclusionLayout occlusion = chooseOcclusion(bins.grid, density);
    const std::vector<uint> stopped = countStopped(field, bins.grid, occlusion);

    bins.positions.reserve(count);
    bins.radiances.reserve(count);
    std::vector<BrickBounds> bricks;
    for (std::size_t record = 0; record < count; ++record) {
        const uint key = order.keys[record], cell = key % cellsPerBrick;
        const LightFieldSample& s = field.samples[order.samples[record]];
        const vec2 p = pinholePosition(s);
        const float radiusRatio = radiusRatioAt(density, p, s.slope, bins.grid.radiusPx);
        if (bricks.empty() || key / cellsPerBrick != bricks.back().key)
            bricks.emplace_back(key / cellsPerBrick, s.slope, radiusRatio);
        bricks.back().add(ivec2(int(cell) % bins.grid.cellsPerBrick, int(cell) / bins.grid.cellsPerBrick),
                          s.slope, radiusRatio);
        // Cells up to this one begin here at the latest.
        bins.cellStart.resize((bricks.size() - 1) * cellsPerBrick + cell + 1, uint(record));
        bins.positions.emplace_back(p, s.slope,
                                    visibilityWeight(stopped, bins.grid, occlusion, p, s.slope,
                                                     radiusRatio / glm::sqrt(1.f + s.areaExcess)));
        bins.radiances.emplace_back(s.r, s.g, s.b, radiusRatio);
    }
    for (const BrickBounds& bounds : bricks) bins.bricks.push_back(bounds.brick(bins.grid));
    bins.cellStart.resize(bins.bricks.size() * cellsPerBrick + 1, uint(count));
    bins.samples = std::move(order.samples);
    return bins;
}

} // namespace slant

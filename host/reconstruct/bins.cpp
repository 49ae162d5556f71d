#include "reconstruct/bins.h"

#include "base/parallel.h"
#include "base/sort.h"
#include "reconstruct/occlusion.h"
#include "reconstruct/points.h"

#include <algorithm>

namespace slant {
namespace {

/// Binned samples sorted by key, those of equal keys by index.
struct Order {
    std::vector<uint> keys, samples;
};

int layerOf(const MovingPoint& point, const GridLayout& grid, const MotionGrid& motion) {
    if (!motion.moves()) return bucketOf(grid, point.trajectory.slope);
    const float rank = rankOf(motion.layout, point.trajectory.slope, point.nearness);
    return int(motion.layers[std::size_t(layerClass(motion.layout, rank, point.motion.velocity))]);
}

Order sortedSamples(const Points& points, const Rect& region, float marginPx, const GridLayout& grid,
                    const MotionGrid& motion) {
    Order order{std::vector<uint>(points.size()), std::vector<uint>(points.size())};
    parallelFor(0, points.size(), 1 << 14, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const MovingPoint point = points[i];
            order.keys[i] = points.reaches(point, region, marginPx)
                                ? sortKey(grid, point.trajectory.pinhole, layerOf(point, grid, motion))
                                : kNotBinned;
            order.samples[i] = uint(i);
        }
    });
    radixSort(order.keys, order.samples, 32);
    order.keys.resize(grid.sampleCount);
    order.samples.resize(grid.sampleCount);
    return order;
}

/// Bounds of a brick while its samples are gathered. Zeros have no sign in them (lib/ordered_float.glsl).
struct BrickBounds {
    uint key; ///< of the brick
    ivec2 first{255}, last{0};
    float slopeMin = kInfinity, slopeMax = -kInfinity, radiusRatio = kInfinity;
    BrickMotion motion{vec2(kInfinity), vec2(-kInfinity), vec2(kInfinity, -kInfinity), vec2(0)};
    vec2 ranks{kInfinity, -kInfinity};

    BrickBounds(uint brickKey, const GridLayout& grid) : key(brickKey) {
        motion.center = brickCenter(grid, place(grid));
    }

    void add(ivec2 cell, float slope, float ownRatio) {
        first = glm::min(first, cell);
        last = glm::max(last, cell);
        slopeMin = std::min(slopeMin, slope + 0.f);
        slopeMax = std::max(slopeMax, slope + 0.f);
        radiusRatio = std::min(radiusRatio, ownRatio);
    }

    void add(const MovingPoint& point, float rank) {
        const vec2 drift = driftOf(point, motion.center) + 0.f;
        motion.low = glm::min(motion.low, drift);
        motion.high = glm::max(motion.high, drift);
        const float rate = point.motion.depthRate + 0.f;
        rank += 0.f;
        motion.depthRate = vec2(std::min(motion.depthRate.x, rate), std::max(motion.depthRate.y, rate));
        ranks = vec2(std::min(ranks.x, rank), std::max(ranks.y, rank));
    }

    Brick brick(const GridLayout& grid) const {
        const ivec2 corner = place(grid) * grid.cellsPerBrick;
        const uvec2 extent = brickExtent(uvec2(corner + first), uvec2(corner + last), radiusRatio);
        return {extent.x, extent.y, slopeMin, slopeMax};
    }

    vec2 rank() const { return 0.5f * vec2(ranks.x + ranks.y, motion.depthRate.x + motion.depthRate.y); }

private:
    ivec2 place(const GridLayout& grid) const {
        return {int(key) % grid.brickCount.x, int(key) / grid.brickCount.x % grid.brickCount.y};
    }
};

/// Visibility weights of samples.
class Weights {
public:
    Weights(const SceneSideSamples& source, const SampleDensity& density, Bins& bins)
        : source_(source), bins_(bins), occlusion_(chooseOcclusion(bins.grid, density, bins.motion)),
          stopped_(countStopped(source, bins.grid, occlusion_, bins.motion)) {}

    float at(uint sample, const MovingPoint& point, float radiusRatio) const {
        const float excess = source_.areaExcess().empty() ? 0.f : source_.areaExcess()[sample];
        const float ratio = radiusRatio / glm::sqrt(1.f + excess);
        const float slope = point.trajectory.slope;
        if (!bins_.motion.moves())
            return visibilityWeight(stopped_, bins_.grid, occlusion_, point.trajectory.pinhole, slope, ratio);
        const MotionLayout& motion = bins_.motion.layout;
        return VisibilityKernels{stopped_}.movingVisibilityWeight(
            occlusion_, motion, point, rankOf(motion, slope, point.nearness), bins_.grid.origin, ratio);
    }

private:
    struct VisibilityKernels {
        const std::vector<uint>& stopped;

        uint stoppedAt(int i) const { return stopped[std::size_t(i)]; }
#include "lib/moving_visibility.glsl"
    };

    const SceneSideSamples& source_;
    const Bins& bins_;
    OcclusionLayout occlusion_;
    std::vector<uint> stopped_;
};

} // namespace

Bins binSamples(const SceneSideSamples& source, const BinScope& scope) {
    const SampleDensity density = densityOf(source);
    const Points points(source);
    Bins bins;
    bins.grid = chooseGrid(source, density, scope);
    bins.motion = chooseMotionGrid(source, bins.grid, density, scope);
    const uint cellsPerBrick = uint(bins.grid.cellsPerBrick) * uint(bins.grid.cellsPerBrick);
    Order order = sortedSamples(points, scope.region, marginPx(scope, density), bins.grid, bins.motion);
    const std::size_t count = order.keys.size();
    const Weights weights(source, density, bins);

    bins.positions.reserve(count);
    bins.values.reserve(count);
    std::vector<BrickBounds> bricks;
    for (std::size_t record = 0; record < count; ++record) {
        const uint key = order.keys[record], cell = key % cellsPerBrick;
        const uint sample = order.samples[record];
        const MovingPoint point = points[sample];
        const auto [p, slope] = point.trajectory;
        const float radiusRatio = radiusRatioAt(density, p, blurOf(point), bins.grid.radiusPx);
        if (bricks.empty() || key / cellsPerBrick != bricks.back().key)
            bricks.emplace_back(key / cellsPerBrick, bins.grid);
        bricks.back().add(ivec2(int(cell) % bins.grid.cellsPerBrick, int(cell) / bins.grid.cellsPerBrick),
                          slope, radiusRatio);
        // Cells up to this one begin here at the latest.
        bins.cellStart.resize((bricks.size() - 1) * cellsPerBrick + cell + 1, uint(record));
        bins.positions.emplace_back(p, slope, weights.at(sample, point, radiusRatio));
        bins.values.emplace_back(0, 0, 0, radiusRatio);
        if (!points.move()) continue;
        bricks.back().add(point, rankOf(bins.motion.layout, slope, point.nearness));
        bins.motions.push_back(texelOf(point.motion));
    }
    for (const BrickBounds& bounds : bricks) {
        bins.bricks.push_back(bounds.brick(bins.grid));
        if (!points.move()) continue;
        bins.brickMotions.push_back(bounds.motion);
        bins.brickRanks.push_back(bounds.rank());
    }
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

std::vector<vec3> valuesOfSamples(std::span<const uint> samples, std::span<const vec4> values,
                                  std::size_t count) {
    std::vector<vec3> ordered(count, vec3(0));
    parallelFor(0, samples.size(), 1 << 14, [&](std::size_t first, std::size_t last) {
        for (std::size_t record = first; record < last; ++record)
            ordered[samples[record]] = vec3(values[record]);
    });
    return ordered;
}

} // namespace slant

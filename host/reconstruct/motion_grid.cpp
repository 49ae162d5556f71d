#include "reconstruct/motion_grid.h"

#include "base/parallel.h"
#include "reconstruct/points.h"

#include <algorithm>
#include <cmath>
#include <mutex>

namespace slant {
namespace {

/// Ranks of a scene spread over at least so many buckets, even if its lens is small.
constexpr float kLeastRanks = 16;
constexpr float kMostRanks = 4096;
/// Width of a class of velocities, pixels per shutter, if there is room for so many layers.
constexpr float kVelocityStep = 8;
constexpr double kMostClasses = 1 << 22;
/// Share of samples at either end that do not count for the spread of ranks.
constexpr double kOutliers = 0.01;
constexpr std::size_t kSpreadSamples = 1 << 16;

struct Spread {
    float low = 0, high = 0;
};

/// Without outliers.
Spread spreadOf(std::vector<float>& values) {
    if (values.empty()) return {};
    const auto outliers = std::ptrdiff_t(kOutliers * double(values.size()));
    const auto low = values.begin() + outliers, high = values.end() - 1 - outliers;
    std::nth_element(values.begin(), low, values.end());
    const float least = *low;
    std::nth_element(values.begin(), high, values.end());
    return {least, *high};
}

/// Sets how ranks are counted.
void setRanks(const Points& points, float bucketWidth, MotionLayout& layout) {
    std::vector<float> slopes, nearness;
    const std::size_t stride = points.size() / kSpreadSamples + 1;
    for (std::size_t i = 0; i < points.size(); i += stride) {
        const MovingPoint point = points[i];
        if (!isEnabled(point.trajectory)) continue;
        slopes.push_back(point.trajectory.slope);
        nearness.push_back(point.nearness);
    }
    const Spread slope = spreadOf(slopes), near = spreadOf(nearness);
    const float least = kLeastRanks * bucketWidth;
    if (slope.high > slope.low)
        layout.rankPerSlope = std::max(1.f, least / (slope.high - slope.low));
    else
        layout.rankPerNearness = near.high > 0 ? least / near.high : 1;
    layout.slopePerRank = layout.rankPerSlope > 0 ? 1 / layout.rankPerSlope : 0;
}

struct Ranges {
    float rankMin = kInfinity, rankMax = -kInfinity;
    vec2 velocityMin{kInfinity}, velocityMax{-kInfinity};
    bool changesDepth = false;

    void add(const MovingPoint& point, float rank) {
        rankMin = std::min(rankMin, rank);
        rankMax = std::max(rankMax, rank);
        velocityMin = glm::min(velocityMin, point.motion.velocity);
        velocityMax = glm::max(velocityMax, point.motion.velocity);
        changesDepth = changesDepth || point.motion.depthRate != 0;
    }
    void add(const Ranges& o) {
        rankMin = std::min(rankMin, o.rankMin);
        rankMax = std::max(rankMax, o.rankMax);
        velocityMin = glm::min(velocityMin, o.velocityMin);
        velocityMax = glm::max(velocityMax, o.velocityMax);
        changesDepth = changesDepth || o.changesDepth;
    }
};

/// The samples that are binned.
class BinnedPoints {
public:
    BinnedPoints(const Points& points, const Rect& region, float marginPx)
        : points_(points), region_(region), marginPx_(marginPx) {}

    /// Calls add(Local&, MovingPoint) for each, then merge(Local) for parts of them, one at a time.
    template <typename Local>
    void gather(const auto& add, const auto& merge) const {
        std::mutex mutex;
        parallelFor(0, points_.size(), 1 << 15, [&](std::size_t first, std::size_t last) {
            Local local;
            for (std::size_t i = first; i < last; ++i)
                if (const MovingPoint point = points_[i]; points_.reaches(point, region_, marginPx_))
                    add(local, point);
            const std::lock_guard lock(mutex);
            merge(local);
        });
    }

private:
    const Points& points_;
    Rect region_;
    float marginPx_;
};

float rankOf(const MotionLayout& layout, const MovingPoint& point) {
    return rankOf(layout, point.trajectory.slope, point.nearness);
}

void setClasses(const Ranges& ranges, float rankStep, float velocityStep, MotionLayout& layout) {
    layout.rankMin = std::max(ranges.rankMin, ranges.rankMax - kMostRanks * rankStep);
    layout.invRank = 1 / rankStep;
    layout.rankCount = std::floor((ranges.rankMax - layout.rankMin) / rankStep) + 1;
    layout.invVelocity = 1 / velocityStep;
    // Zero lies in the middle of a class: noise of what keeps still does not part it.
    layout.velocityMin = (glm::floor(ranges.velocityMin / velocityStep + 0.5f) - 0.5f) * velocityStep;
    layout.velocityCount = glm::floor((ranges.velocityMax - layout.velocityMin) / velocityStep) + 1.f;
}

double classCount(const MotionLayout& layout) {
    return double(layout.rankCount) * double(layout.velocityCount.x) * double(layout.velocityCount.y);
}

/// Numbers the classes that occur.
void numberLayers(const BinnedPoints& binned, MotionGrid& grid) {
    grid.layers.assign(std::size_t(classCount(grid.layout)), 0);
    binned.gather<std::vector<int>>(
        [&](std::vector<int>& classes, const MovingPoint& point) {
            const int own = layerClass(grid.layout, rankOf(grid.layout, point), point.motion.velocity);
            if (classes.empty() || classes.back() != own) classes.push_back(own);
        },
        [&](const std::vector<int>& classes) {
            for (const int own : classes) grid.layers[std::size_t(own)] = 1;
        });
    grid.layerCount = 0;
    for (uint& layer : grid.layers)
        if (layer != 0) layer = grid.layerCount++;
}

} // namespace

float MotionGrid::fastestPx() const {
    if (!moves()) return 0;
    const vec2 high = layout.velocityMin + layout.velocityCount / layout.invVelocity;
    const vec2 most = glm::max(glm::abs(layout.velocityMin), glm::abs(high));
    return std::max(most.x, most.y);
}

MotionGrid chooseMotionGrid(const SceneSideSamples& samples, const GridLayout& layout,
                            const SampleDensity& density, const BinScope& scope) {
    const Points points(samples);
    MotionGrid grid;
    if (!points.move()) return grid;
    const BinnedPoints binned(points, scope.region, marginPx(scope, density));
    grid.layout.c2 = samples.field().slopeModel.c2;
    grid.layout.shutterSpan = 1;
    grid.layout.brickPx = float(layout.cellsPerBrick) / layout.invCell;
    setRanks(points, layout.surfaceGap, grid.layout);

    Ranges ranges;
    binned.gather<Ranges>(
        [&](Ranges& local, const MovingPoint& point) { local.add(point, rankOf(grid.layout, point)); },
        [&](const Ranges& local) { ranges.add(local); });
    if (!(ranges.rankMin <= ranges.rankMax)) ranges.add(MovingPoint{}, 0);
    grid.changesDepth = ranges.changesDepth;
    const vec2 widest(float(std::max(scope.region.width(), scope.region.height())));
    ranges.velocityMin = glm::clamp(ranges.velocityMin, -widest, widest);
    ranges.velocityMax = glm::clamp(ranges.velocityMax, -widest, widest);

    const double cells =
        double(layout.brickCount.x) * layout.brickCount.y * layout.cellsPerBrick * layout.cellsPerBrick;
    float rankStep = layout.surfaceGap, velocityStep = kVelocityStep;
    for (;;) {
        setClasses(ranges, rankStep, velocityStep, grid.layout);
        if (classCount(grid.layout) <= kMostClasses) {
            numberLayers(binned, grid);
            if (cells * grid.layerCount < double(kNotBinned)) return grid;
        }
        if (grid.layout.velocityCount != vec2(1))
            velocityStep *= 2;
        else
            rankStep *= 2;
    }
}

} // namespace slant

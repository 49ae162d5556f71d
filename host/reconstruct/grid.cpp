#include "reconstruct/grid.h"

#include "base/parallel.h"
#include "reconstruct/points.h"

#include <algorithm>
#include <cmath>
#include <mutex>

namespace slant {
namespace {

/// On lavapipe, times are flat between 0.5 and 1.4.
constexpr float kCellPerRadius = 0.7f;
constexpr float kBrickPx = 16;
constexpr int kMaxCellsPerBrick = 64;
/// Two surfaces this far apart in slope can hide each other: 0.1 px over a lens step of 1/sqrt(128) (Lehtinen
/// et al. 2011); or R, so that what is behind does not shine through at smaller distances.
constexpr float kSurfaceSlopeStep = 1.13f;

struct Bounds {
    vec2 min{kInfinity}, max{-kInfinity};
    float slopeMin = kInfinity, slopeMax = -kInfinity;
    std::uint64_t count = 0;

    void add(vec2 p) {
        ++count;
        min = glm::min(min, p);
        max = glm::max(max, p);
    }
    void add(float slope) {
        slopeMin = std::min(slopeMin, slope);
        slopeMax = std::max(slopeMax, slope);
    }
    void add(const Bounds& o) {
        count += o.count;
        min = glm::min(min, o.min);
        max = glm::max(max, o.max);
        slopeMin = std::min(slopeMin, o.slopeMin);
        slopeMax = std::max(slopeMax, o.slopeMax);
    }
};

Bounds boundsOf(const Points& points, const Rect& region, float marginPx) {
    Bounds all;
    std::mutex mutex;
    parallelFor(0, points.size(), 1 << 15, [&](std::size_t first, std::size_t last) {
        Bounds local;
        for (std::size_t i = first; i < last; ++i) {
            const MovingPoint point = points[i];
            if (!points.reaches(point, region, marginPx)) continue;
            local.add(point.trajectory.pinhole);
            local.add(point.trajectory.slope);
            if (point.motion.slopeRate == 0) continue;
            for (const float time : {-0.5f, 0.5f})
                local.add(atTime(point.trajectory, point.motion, time).slope);
        }
        const std::lock_guard lock(mutex);
        all.add(local);
    });
    return all;
}

} // namespace

float emptyCircleRadius(float samplesPerPixel) {
    return kSearchRadius / std::sqrt(samplesPerPixel);
}

float widestSearchPx(const SampleDensity& density) {
    return float(2 << kWidenings) * emptyCircleRadius(density.least);
}

float marginPx(const BinScope& scope, const SampleDensity& density) {
    return scope.anyFocus ? kInfinity : widestSearchPx(density);
}

float largestSlope(const GridLayout& grid) {
    return std::max(std::abs(grid.slopeMin),
                    std::abs(grid.slopeMin + float(grid.bucketCount) / grid.invBucket));
}

GridLayout chooseGrid(const SceneSideSamples& samples, const SampleDensity& density, const BinScope& scope) {
    const Rect& region = scope.region;
    const Points points(samples);
    Bounds bounds = boundsOf(points, region, marginPx(scope, density));
    GridLayout grid{};
    grid.sampleCount = uint(bounds.count);
    if (bounds.count == 0) {
        bounds.add(vec2(0));
        bounds.add(0.f);
    }
    grid.radiusPx = emptyCircleRadius(density.least);
    const float typicalRadiusPx = emptyCircleRadius(density.typical);

    const float widestPx = float(std::max(region.width(), region.height())) / 2;
    const float slopeMin = std::clamp(bounds.slopeMin, -widestPx, widestPx);
    const float slopeMax = std::clamp(bounds.slopeMax, -widestPx, widestPx);
    const vec2 regionMin(float(region.x0), float(region.y0)), regionMax(float(region.x1), float(region.y1));
    const vec2 low = glm::max(bounds.min, regionMin - widestPx),
               high = glm::min(bounds.max, regionMax + widestPx);
    grid.slopeMin = slopeMin;
    grid.origin = glm::floor(glm::min(low, high));

    float cellPx = typicalRadiusPx * kCellPerRadius;
    float bucketWidth = std::min(kSurfaceSlopeStep, typicalRadiusPx);
    grid.cellsPerBrick = std::clamp(int(std::lround(kBrickPx / cellPx)), 1, kMaxCellsPerBrick);
    for (;;) {
        grid.invCell = 1 / cellPx;
        grid.invBucket = 1 / bucketWidth;
        grid.surfaceGap = bucketWidth;
        grid.brickCount = ivec2((high - grid.origin) * (grid.invCell / float(grid.cellsPerBrick))) + 1;
        grid.brickCount = glm::max(grid.brickCount, ivec2(1));
        grid.bucketCount = int((slopeMax - slopeMin) * grid.invBucket) + 1;
        const double cells =
            double(grid.brickCount.x) * grid.brickCount.y * grid.cellsPerBrick * grid.cellsPerBrick;
        const int widest = std::max(grid.brickCount.x, grid.brickCount.y) * grid.cellsPerBrick;
        const int layers = points.move() ? std::max(grid.bucketCount, kMinLayers) : grid.bucketCount;
        if (cells * layers < double(kNotBinned) && widest <= 1 << 15) return grid;
        if (grid.bucketCount > 64 && widest <= 1 << 15)
            bucketWidth *= 2;
        else
            cellPx *= 2;
    }
}

} // namespace slant

#include "reconstruct/density.h"

#include "base/parallel.h"
#include "reconstruct/points.h"

#include <algorithm>
#include <cmath>
#include <mutex>

namespace slant {
namespace {

std::vector<uint> summedCounts(const LightField& field) {
    const std::size_t width = std::size_t(field.bounds.width()), height = std::size_t(field.bounds.height());
    std::vector<uint> sums((width + 1) * (height + 1));
    for (std::size_t row = 0; row < height; ++row) {
        const std::uint32_t* start = field.pixelStart.data() + row * width;
        for (std::size_t i = 0; i <= width; ++i)
            sums[(row + 1) * (width + 1) + i] = sums[row * (width + 1) + i] + (start[i] - start[0]);
    }
    return sums;
}

float leastAround(const Points& points, const SampleDensity& density) {
    float least = kInfinity;
    std::mutex mutex;
    parallelFor(0, points.size(), 1 << 14, [&](std::size_t first, std::size_t last) {
        float local = kInfinity;
        for (std::size_t i = first; i < last; ++i) {
            const MovingPoint point = points[i];
            if (isEnabled(point.trajectory))
                local = std::min(local, samplesAround(density, point.trajectory.pinhole, blurOf(point)));
        }
        const std::lock_guard lock(mutex);
        least = std::min(least, local);
    });
    return std::isfinite(least) ? least : density.typical;
}

} // namespace

SampleDensity densityOf(const SceneSideSamples& samples) {
    const LightField& field = samples.field();
    SampleDensity density;
    if (field.pixelStart.empty()) {
        density.least = density.typical = float(field.samplesPerPixel);
        return density;
    }
    density.layout = {ivec2(field.bounds.x0, field.bounds.y0),
                      ivec2(field.bounds.width(), field.bounds.height())};
    density.sums = summedCounts(field);
    density.typical = float(sampleCounts(field).mean);
    density.least = leastAround(Points(samples), density);
    return density;
}

namespace {

struct DensityKernels {
    const uint* sums;

    uint sumAt(uint i) const { return sums[i]; }
#include "lib/density.glsl"
};

} // namespace

float samplesAround(const SampleDensity& density, vec2 p, float slope) {
    if (density.layout.size.x == 0) return density.typical;
    return DensityKernels{density.sums.data()}.samplesAround(density.layout, p, slope);
}

float radiusRatioAt(const SampleDensity& density, vec2 p, float slope, float radiusPx) {
    return DensityKernels{density.sums.data()}.radiusRatioAt(density.layout, p, slope, radiusPx);
}

} // namespace slant

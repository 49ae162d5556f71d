#include "reconstruct/density.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>
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

float leastAround(std::span<const LightFieldSample> samples, const SampleDensity& density) {
    float least = std::numeric_limits<float>::infinity();
    std::mutex mutex;
    parallelFor(0, samples.size(), 1 << 14, [&](std::size_t first, std::size_t last) {
        float local = std::numeric_limits<float>::infinity();
        for (std::size_t i = first; i < last; ++i) {
            const LightFieldSample& s = samples[i];
            if (std::isfinite(s.slope))
                local = std::min(local, samplesAround(density, pinholePosition(s), s.slope));
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
    density.least = leastAround(samples.samples(), density);
    return density;
}

float samplesAround(const SampleDensity& density, vec2 p, float slope) {
    const DensityLayout& layout = density.layout;
    if (layout.size.x == 0) return density.typical;
    const float halfPx = glm::max(kHalfSquareOfDisc * glm::abs(slope), kMinHalfPx);
    const vec2 place = p - vec2(layout.origin), size = vec2(layout.size);
    const vec2 low = glm::clamp(glm::floor(place - halfPx + 0.5f), vec2(0), size - 1.f);
    const vec2 high = glm::clamp(glm::floor(place + halfPx + 0.5f), low + 1.f, size);
    const auto sumTo = [&](float x, float y) {
        return density.sums[std::size_t(y) * std::size_t(layout.size.x + 1) + std::size_t(x)];
    };
    const uint count =
        (sumTo(high.x, high.y) - sumTo(low.x, high.y)) - (sumTo(high.x, low.y) - sumTo(low.x, low.y));
    return glm::max(float(count) / ((high.x - low.x) * (high.y - low.y)), kMinDensity);
}

float radiusRatioAt(const SampleDensity& density, vec2 p, float slope, float radiusPx) {
    if (density.layout.size.x == 0) return 1;
    return glm::max(glm::sqrt(samplesAround(density, p, slope)) * (radiusPx / kSearchRadius), 1.f);
}

} // namespace slant

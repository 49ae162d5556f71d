#include "reconstruct/window.h"

#include "base/parallel.h"
#include "reconstruct/density.h"
#include "reconstruct/hull.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace slant {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
/// A pinhole position that no output is near to.
constexpr float kNowherePx = 1e18f;

/// Distance of samples.
float spacingPx(float samplesPerPixel) {
    return 1 / std::sqrt(samplesPerPixel);
}

/// What is known of an apparent surface.
struct WindowSurface {
    int count = 0;
    vec3 sum{0};
    float weightSum = 0;
    Hull hull;
};

void addSample(WindowSurface& surface, const WindowCandidate& candidate, const vec3& rgb, float alpha) {
    const float weight = expOfMinus(glm::min(alpha * candidate.distance2, kMaxExponent));
    surface.count += 1;
    surface.sum += weight * rgb;
    surface.weightSum += weight;
    addPoint(surface.hull, candidate.offset);
}

/// Whether two trajectories have the same order, in x and in y, a lens step to either side.
bool sameSurface(const WindowCandidate& a, const WindowCandidate& b, float lensStep) {
    const vec2 apart = a.offset - b.offset;
    const float shear = (a.slope - b.slope) * lensStep;
    return (apart.x + shear > 0) == (apart.x - shear > 0) && (apart.y + shear > 0) == (apart.y - shear > 0);
}

/// Samples of the window that reproject to within the radius, front to back, in the order of samples where
/// slopes are equal. Returns the nearest sample of the whole window, an index past the last if there is none.
std::size_t collect(const WindowSamples& samples, const WindowSearch& search, ivec2 pixel,
                    const Output& output, std::vector<WindowCandidate>& found) {
    found.clear();
    std::size_t nearest = samples.positions.size();
    float nearest2 = kInfinity;
    const ivec2 center = pixel - search.boundsOrigin;
    const ivec2 first = glm::max(center - search.rangePx, ivec2(0));
    const ivec2 last = glm::min(center + search.rangePx, search.boundsSize - 1);
    for (int y = first.y; y <= last.y; ++y) {
        const std::size_t row = std::size_t(y) * std::size_t(search.boundsSize.x);
        if (last.x < first.x) break;
        const uint begin = samples.pixelStart[row + std::size_t(first.x)];
        const uint end = samples.pixelStart[row + std::size_t(last.x) + 1];
        for (uint record = begin; record < end; ++record) {
            const vec4& position = samples.positions[record];
            vec2 offset = vec2(position.x, position.y) + position.z * output.uv - output.xy;
            if (output.compoundLens) offset = onFilm(output, offset);
            const float distance2 = offset.x * offset.x + offset.y * offset.y;
            if (distance2 < nearest2) {
                nearest2 = distance2;
                nearest = record;
            }
            if (distance2 < position.w) found.push_back({offset, distance2, position.z, record});
        }
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const auto& left, const auto& right) { return left.slope < right.slope; });
    return nearest;
}

} // namespace

float expOfMinus(float x) {
    const float n = glm::floor(x * 1.44269504f + 0.5f);
    const float r = (x - n * 0.693145752f) - n * 1.42860677e-6f;
    const float series =
        1.f + r * (-1.f + r * (0.5f + r * (-0.166666667f + r * (0.0416666667f + r * (-0.00833333333f +
                                                                                     r * 0.00138888889f)))));
    return series * std::bit_cast<float>(uint(127 - int(n)) << 23);
}

WindowSamples windowSamples(const SceneSideSamples& source, ValuePlane plane) {
    const SampleDensity density = densityOf(source);
    const LightField& field = source.field();
    const std::size_t count = source.samples().size();
    WindowSamples samples{std::vector<vec4>(count), std::vector<vec4>(count),
                          std::vector<uint>(field.bounds.area() + 1)};
    for (std::size_t pixel = 0; pixel < samples.pixelStart.size(); ++pixel)
        samples.pixelStart[pixel] = uint(field.firstSample(pixel));
    parallelFor(0, count, 1 << 14, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const LightFieldSample& s = source.samples()[i];
            const vec2 p = pinholePosition(s);
            const bool seen = std::isfinite(p.x) && std::isfinite(p.y); // so that p + slope u is no NaN
            const float around = seen ? samplesAround(density, p, s.slope) : 1.f;
            const float radiusPx = 2 * spacingPx(around);
            samples.positions[i] =
                seen ? vec4(p, s.slope, radiusPx * radiusPx) : vec4(kNowherePx, kNowherePx, 0, 0);
            samples.values[i] = vec4(source.value(plane, i), s.alpha);
        }
    });
    return samples;
}

WindowSearch windowSearch(const LightField& field, const WindowOptions& options) {
    WindowSearch search{};
    search.boundsOrigin = ivec2(field.bounds.x0, field.bounds.y0);
    search.boundsSize = ivec2(field.bounds.width(), field.bounds.height());
    search.rangePx = options.rangePx;
    search.alpha = options.alpha;
    search.lensStep = options.lensStep.value_or(spacingPx(float(sampleCounts(field).mean)));
    search.fill = options.fill;
    return search;
}

std::uint64_t windowSteps(const LightField& field, const WindowSearch& search) {
    const auto width = std::uint64_t(2 * search.rangePx + 1);
    return width + width * width * sampleCounts(field).max;
}

WindowResult lookThroughWindow(const WindowSamples& samples, const WindowSearch& search, ivec2 pixel,
                               const Output& output, std::vector<WindowCandidate>& scratch) {
    const std::size_t nearest = collect(samples, search, pixel, output, scratch);
    if (scratch.empty()) {
        if (search.fill == 0 || nearest == samples.positions.size()) return {};
        return {WindowOutcome::filled, vec3(samples.values[nearest])};
    }
    WindowSurface front, surface;
    const WindowCandidate* previous = nullptr;
    bool taken = false;
    for (const WindowCandidate& candidate : scratch) {
        if (surface.count >= kMinSurface && !sameSurface(*previous, candidate, search.lensStep)) {
            taken = surrounds(surface.hull);
            if (taken) break;
            if (front.count == 0) front = surface;
            surface = WindowSurface{};
        }
        addSample(surface, candidate, vec3(samples.values[candidate.record]), search.alpha);
        previous = &candidate;
    }
    taken = taken || surrounds(surface.hull);
    const bool parted = taken ? surface.count < int(scratch.size()) : front.count > 0;
    if (!taken && front.count > 0) surface = front;
    return {parted ? WindowOutcome::parted : WindowOutcome::found, surface.sum / surface.weightSum};
}

} // namespace slant

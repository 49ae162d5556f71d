#include "reconstruct/window.h"

#include "base/parallel.h"
#include "reconstruct/density.h"
#include "reconstruct/points.h"

#include <algorithm>
#include <cmath>

namespace slant {
namespace {

/// A pinhole position that is far from every output.
constexpr float kNowherePx = 1e18f;

/// Distance of samples.
float spacingPx(float samplesPerPixel) {
    return 1 / std::sqrt(samplesPerPixel);
}

template <bool kMoving>
struct WindowKernels {
    const WindowSamples& samples;
    std::vector<WindowCandidate>& kept;

    const vec4& positionAt(uint record) const { return samples.positions[record]; }
    const vec4& valueAt(uint record) const { return samples.values[record]; }
    const vec4& motionAt(uint record) const { return samples.motions[record]; }
    uint pixelStartAt(int pixel) const { return samples.pixelStart[std::size_t(pixel)]; }
    void keepCandidate(int, const WindowCandidate& candidate) { kept.push_back(candidate); }
    const WindowCandidate& keptCandidate(int place, const Output&) const { return kept[std::size_t(place)]; }
    void sortCandidates(int) {
        std::stable_sort(kept.begin(), kept.end(),
                         [](const auto& left, const auto& right) { return left.slope < right.slope; });
    }
#include "lib/window.glsl"
};

} // namespace

WindowSamples windowSamples(const SceneSideSamples& source, ValuePlane plane) {
    const SampleDensity density = densityOf(source);
    const LightField& field = source.field();
    const std::size_t count = source.samples().size();
    const Points points(source);
    WindowSamples samples{std::vector<vec4>(count), std::vector<vec4>(count),
                          std::vector<vec4>(points.move() ? count : 0),
                          std::vector<uint>(field.bounds.area() + 1)};
    for (std::size_t pixel = 0; pixel < samples.pixelStart.size(); ++pixel)
        samples.pixelStart[pixel] = uint(field.firstSample(pixel));
    parallelFor(0, count, 1 << 14, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const MovingPoint point = points[i];
            const auto [p, slope] = point.trajectory;
            const bool seen = std::isfinite(p.x) && std::isfinite(p.y); // so that p + slope u is no NaN
            const float around = seen ? samplesAround(density, p, blurOf(point)) : 1.f;
            const float radiusPx = 2 * spacingPx(around);
            samples.positions[i] =
                seen ? vec4(p, slope, radiusPx * radiusPx) : vec4(kNowherePx, kNowherePx, 0, 0);
            samples.values[i] = vec4(source.value(plane, i), points.sample(i).alpha);
            if (points.move()) samples.motions[i] = seen ? texelOf(point.motion) : vec4(0);
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
    scratch.clear();
    const auto look = [&](auto kernels) -> WindowResult {
        const auto finds = kernels.collect(search, pixel, output);
        const auto view = kernels.viewOf(search, finds, output);
        return {WindowOutcome(view.outcome), view.rgb};
    };
    return samples.motions.empty() ? look(WindowKernels<false>{samples, scratch})
                                   : look(WindowKernels<true>{samples, scratch});
}

} // namespace slant

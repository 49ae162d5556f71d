#include "camera/lens_distortion.h"

#include "shared/kernel.h"

#include <algorithm>
#include <cmath>

namespace slant {
namespace {

constexpr int kRatios = 1024;
constexpr float kMaxRadii = 1 << 16;
/// Beyond anything that a lens does: what a file may have is kept below, so that all stays finite.
constexpr float kMostSteep = 1e6f, kMostAberrationPx = 128;

/// The radii of a lens map, on to `count`.
std::vector<vec4> extendedRadii(const std::vector<vec4>& texels, double step, std::size_t count) {
    const auto* first = texels.data() + kLensMapHeader;
    std::vector<vec4> radii(first, first + std::size_t(texels[0].w));
    const vec4 last = radii.back();
    const double end = double(radii.size() - 1);
    for (std::size_t i = radii.size(); i < count; ++i) {
        const double distance = double(last.x) + (double(i) - end) * step * double(last.y);
        radii.emplace_back(distance, last.y, distance / (double(i) * step), 0);
    }
    for (vec4& radius : radii) radius.w = 1;
    return radii;
}

/// Film radius over distance on the scene's side, at steps that grow with that, up to infinity.
std::vector<double> ratiosOf(const std::vector<vec4>& radii, double step, double halfway) {
    std::vector<double> ratios{1 / double(radii[0].z)};
    std::size_t k = 0;
    for (int i = 1; i < kRatios; ++i) {
        const double distance = halfway * double(i) / (kRatios - i);
        while (k + 2 < radii.size() && double(radii[k + 1].x) <= distance) ++k;
        const double from = double(radii[k].x), to = double(radii[k + 1].x);
        const double part = to > from ? std::clamp((distance - from) / (to - from), 0.0, 1.0) : 0;
        ratios.push_back((double(k) + part) * step / distance);
    }
    ratios.push_back(0);
    for (double& ratio : ratios) ratio = std::min(ratio, double(kMostSteep));
    return ratios;
}

struct DistortionKernels {
    const vec4* texels;
    vec4 distortionHead = texels[0];

    const vec4& distortionAt(int texel) const { return texels[texel]; }
#include "lib/lens_distortion.glsl"
};

} // namespace

LensDistortion::LensDistortion(const LensMap& lens, float radiusPx) {
    const std::vector<vec4>& texels = lens.texels();
    const double step = 1 / double(texels[0].z);
    const auto count =
        std::size_t(std::max(texels[0].w, std::min(std::ceil(radiusPx * texels[0].z) + 2, kMaxRadii)));
    std::vector<vec4> radii = extendedRadii(texels, step, count);
    steepest_ = 0;
    for (std::size_t i = 1; i < count; ++i) {
        radii[i].x = std::max(radii[i].x, radii[i - 1].x); // whatever a file has
        steepest_ = std::max(steepest_, std::min(1 / std::min(radii[i].y, radii[i].z), kMostSteep));
    }
    // Where the film would see almost to the side, distances are any number of pixels.
    const double halfway =
        std::max(std::min(double(radii[0].z), double(kMostSteep)) * double(radiusPx), step);
    const std::vector<double> ratios = ratiosOf(radii, step, halfway);
    texels_.emplace_back(vec2(texels[0]), halfway, kRatios);
    for (std::size_t i = 0; i < ratios.size(); ++i)
        texels_.emplace_back(ratios[i], i + 1 < ratios.size() ? ratios[i + 1] - ratios[i] : 0, 0, 0);

    const std::size_t nodes =
        std::size_t(texels[1].y) * (std::size_t(texels[1].z) + 1) * (std::size_t(texels[1].w) + 1);
    const std::size_t first = kLensMapHeader + std::size_t(texels[0].w);
    pupilReach_ = 0;
    for (std::size_t i = first; i < first + nodes; ++i) {
        const float aberration = std::min(glm::length(vec2(texels[i])), kMostAberrationPx);
        aberrationPx_ = std::max(aberrationPx_, aberration);
        pupilReach_ = std::max(pupilReach_, glm::length(vec2(texels[i].z, texels[i].w)));
    }

    const float few = 2;
    std::vector<vec4> pinhole{vec4(vec2(texels[0]), texels[0].z, count), vec4(texels[1].x, few, 1, 1),
                              vec4(0)};
    pinhole.insert(pinhole.end(), radii.begin(), radii.end());
    pinhole.insert(pinhole.end(), 2 * 2 * 2, vec4(0));
    pinhole_ = LensMap(std::move(pinhole));
}

vec2 LensDistortion::onFilm(vec2 pinhole) const {
    return DistortionKernels{texels_.data()}.distorted(pinhole);
}

} // namespace slant

#include "reconstruct/search.h"

#include "reconstruct/surface.h"

#include <limits>

namespace slant {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

} // namespace

Reconstructed reconstructNearest(const SearchContext& context, const Output& output) {
    const GridLayout& grid = context.bins.grid;
    const float invRadius = 1 / grid.radiusPx;
    vec3 sum(0);
    float weightSum = 0, slopeMax = -kInfinity;
    Hull hull;
    bool another = false; ///< there is a surface behind
    Reconstructed result;
    const auto isSolid = [&] { return weightSum >= kSolidInner * kFullWeight && surrounds(hull); };
    const auto visit = [&](const Candidate& candidate) {
        another = weightSum > 0 && candidate.slope > slopeMax + grid.surfaceGap;
        if (another) return false;
        const float weight = candidate.weight * (1 - glm::sqrt(candidate.distance2) * invRadius);
        sum += weight * vec3(candidate.value);
        weightSum += weight;
        slopeMax = glm::max(slopeMax, candidate.slope);
        addPoint(hull, candidate.offset);
        return true;
    };
    const auto hides = [&](const Brick& brick) {
        return brick.slopeMin > slopeMax + grid.surfaceGap && isSolid();
    };
    result.iterations = forEachCandidate(context, output, grid.radiusPx, kAnyRadiusRatio, visit, hides);
    const bool taken = another ? isSolid() : weightSum > 0;
    result.outcome = taken ? Outcome::resolved : Outcome::needsVisibility;
    if (taken) result.rgb = sum / weightSum;
    return result;
}

namespace {

/// Surfaces laid over one another, front to back.
struct Layers {
    vec3 rgb{0};
    float transmittance = 1;
};

/// Adds a surface that has another one behind it. Where it is not solid it covers as much as its samples are
/// many: a rim, or a thing smaller than R, keeps its area on average and so its brightness.
void addSurface(Layers& layers, const Surface& s, float fullWeight) {
    const float opacity = isSolid(s, fullWeight) ? 1.f : glm::min(s.innerWeight / fullWeight, 1.f);
    if (opacity > 0) layers.rgb += layers.transmittance * opacity * meanOf(s);
    layers.transmittance *= 1 - opacity;
}

} // namespace

Reconstructed resolveVisibility(const SearchContext& context, const Output& output, float baseRadius) {
    const GridLayout& grid = context.bins.grid;
    const float widening = baseRadius / grid.radiusPx;
    const float fullWeight = kFullWeight * widening * widening;
    Surface surface;
    Layers layers;
    Reconstructed result;
    const auto visit = [&](const Candidate& candidate) {
        if (surface.count > 0 && candidate.slope > surface.slopeMax + grid.surfaceGap) {
            addSurface(layers, surface, fullWeight);
            surface = Surface{};
            if (!(layers.transmittance > 0)) return false;
        }
        addSample(surface, candidate, baseRadius);
        return true;
    };
    const auto hides = [&](const Brick& brick) {
        return brick.slopeMin > surface.slopeMax + grid.surfaceGap && isSolid(surface, fullWeight);
    };
    result.iterations = forEachCandidate(context, output, 2 * baseRadius, kAnyRadiusRatio, visit, hides);
    if (surface.count > 0) layers.rgb += layers.transmittance * meanOf(surface);
    if (surface.count > 0 || !(layers.transmittance > 0)) result.outcome = Outcome::resolved;
    result.rgb = layers.rgb;
    return result;
}

} // namespace slant

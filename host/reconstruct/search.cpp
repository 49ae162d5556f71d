#include "reconstruct/search.h"

#include "reconstruct/hull.h"

#include <limits>

namespace slant {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// A sample seen from the output's lens position.
struct Candidate {
    vec2 offset; ///< from the output, pixels
    float distance2;
    float slope;
    float weight; ///< see visibilityWeight
    uint record;
};

ivec2 cellAt(const GridLayout& grid, vec2 place) {
    const ivec2 cells = grid.brickCount * grid.cellsPerBrick;
    return ivec2(glm::clamp(glm::floor(place), vec2(0), vec2(cells - 1)));
}

/// Calls visit for the samples that reproject to within `radius` of the output, until it returns false or
/// hides(brick) says that what was met so far hides a brick and all that follow. They come in the order of
/// their bricks: front to back, up to the width of a bucket. Returns loop steps.
template <typename Visit, typename Hides>
int forEachCandidate(const SearchContext& context, const Output& output, float radius, Visit&& visit,
                     Hides&& hides) {
    const GridLayout& grid = context.bins.grid;
    const int side = grid.cellsPerBrick;
    // In cells: where the output lies, how far its window moves with slope, and its half width.
    const vec2 center = (output.xy - grid.origin) * grid.invCell, shear = output.uv * grid.invCell;
    const float reach = radius * grid.invCell;
    int iterations = 0;
    for (const uint id : context.bricks) {
        const Brick& brick = context.bins.bricks[id];
        const vec2 a = brick.slopeMin * shear, b = brick.slopeMax * shear;
        const ivec2 first = glm::max(cellAt(grid, center - glm::max(a, b) - reach), firstCell(brick));
        const ivec2 last = glm::min(cellAt(grid, center - glm::min(a, b) + reach), lastCell(brick));
        ++iterations;
        if (hides(brick)) return iterations;
        if (first.x > last.x || first.y > last.y) continue;
        const ivec2 corner = first / side * side;
        for (int row = first.y; row <= last.y; ++row) {
            const std::size_t cell = (std::size_t(id) * side + (row - corner.y)) * side - corner.x;
            const uint begin = context.bins.cellStart[cell + first.x];
            const uint end = context.bins.cellStart[cell + last.x + 1];
            iterations += int(end - begin) + 1;
            for (uint record = begin; record < end; ++record) {
                const vec4& position = context.bins.positions[record];
                const vec2 offset = vec2(position.x, position.y) + position.z * output.uv - output.xy;
                const float distance2 = offset.x * offset.x + offset.y * offset.y;
                if (distance2 < radius * radius &&
                    !visit(Candidate{offset, distance2, position.z, position.w, record}))
                    return iterations;
            }
        }
    }
    return iterations;
}

vec3 radianceOf(const SearchContext& context, const Candidate& candidate) {
    return vec3(context.bins.radiances[candidate.record]);
}

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
        sum += weight * radianceOf(context, candidate);
        weightSum += weight;
        slopeMax = glm::max(slopeMax, candidate.slope);
        addPoint(hull, candidate.offset);
        return true;
    };
    const auto hides = [&](const Brick& brick) {
        return brick.slopeMin > slopeMax + grid.surfaceGap && isSolid();
    };
    result.iterations = forEachCandidate(context, output, grid.radiusPx, visit, hides);
    const bool taken = another ? isSolid() : weightSum > 0;
    result.outcome = taken ? Outcome::resolved : Outcome::needsVisibility;
    if (taken) result.rgb = sum / weightSum;
    return result;
}

namespace {

/// What is known of an apparent surface around an output.
struct Surface {
    int count = 0; ///< samples within twice the base radius
    float slopeMax = -kInfinity;
    vec3 innerSum{0}, outerSum{0}; ///< tents over the base radius and over twice that
    float innerWeight = 0, outerWeight = 0;
    Hull hull;
};

void addSample(Surface& surface, const Candidate& candidate, const vec3& rgb, float baseRadius) {
    const float distance = glm::sqrt(candidate.distance2) / baseRadius;
    const float inner = candidate.weight * glm::max(1 - distance, 0.f),
                outer = candidate.weight * (2 - distance);
    surface.count += 1;
    surface.slopeMax = glm::max(surface.slopeMax, candidate.slope);
    surface.innerSum += inner * rgb;
    surface.innerWeight += inner;
    surface.outerSum += outer * rgb;
    surface.outerWeight += outer;
    addPoint(surface.hull, candidate.offset);
}

vec3 meanOf(const Surface& s) {
    return s.innerWeight > 0 ? s.innerSum / s.innerWeight : s.outerSum / s.outerWeight;
}

/// Surfaces laid over one another, front to back.
struct Layers {
    vec3 rgb{0};
    float transmittance = 1;
};

/// A surface whose samples surround the output, and as many as if it lay inside and not at the rim, hides
/// what is behind.
bool isSolid(const Surface& s, float fullWeight) {
    const float fullOuterWeight = 8 * fullWeight; // tent twice as wide, and twice as high
    return surrounds(s.hull) && s.outerWeight >= kSolidOuter * fullOuterWeight;
}

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
        addSample(surface, candidate, radianceOf(context, candidate), baseRadius);
        return true;
    };
    const auto hides = [&](const Brick& brick) {
        return brick.slopeMin > surface.slopeMax + grid.surfaceGap && isSolid(surface, fullWeight);
    };
    result.iterations = forEachCandidate(context, output, 2 * baseRadius, visit, hides);
    if (surface.count > 0) layers.rgb += layers.transmittance * meanOf(surface);
    if (surface.count > 0 || !(layers.transmittance > 0)) result.outcome = Outcome::resolved;
    result.rgb = layers.rgb;
    return result;
}

} // namespace slant

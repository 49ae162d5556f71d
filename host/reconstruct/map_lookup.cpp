#include "reconstruct/map_lookup.h"

#include "reconstruct/kernels.h"

#include <cmath>
#include <numbers>

namespace slant {
namespace {

struct ClassifyKernels {
    const Bins& bins;
    std::span<const uint> bricks;
    const MapLayout& mapLayout;
    std::vector<Cluster>& clusters;
    const MotionLayout& motionLayout = bins.motion.layout;

    const Brick& listedBrick(uint entry) const { return bins.bricks[bricks[entry]]; }
    const BrickMotion& listedMotion(uint entry) const { return bins.brickMotions[bricks[entry]]; }
    const Cluster& keptCluster(uint i) const { return clusters[i]; }
    void keepCluster(uint i, const Cluster& cluster) {
        if (i == clusters.size()) clusters.emplace_back();
        clusters[i] = cluster;
    }
#include "lib/classify_moving.glsl"
};

template <bool kMoving, bool kCompoundLens>
struct LookupKernels {
    const LayerMap& map;
    std::span<const Cluster> clusters;
    const MapLayout& mapLayout = map.layout;
    const MotionLayout& motionLayout = map.motionLayout;
    vec4 distortionHead = kCompoundLens ? map.distortion[0] : vec4(0);

    const vec4& distortionAt(int i) const { return map.distortion[std::size_t(i)]; }
    const uvec4& mapTexelAt(int i) const { return map.texels[std::size_t(i)]; }
    const uvec4& mapMotionAt(int i) const { return map.motions[std::size_t(i)]; }
    const Cluster& clusterAt(int i) const { return clusters[std::size_t(i)]; }
#include "lib/map_lookup.glsl"
};

} // namespace

LensSight sightThrough(const LensBox& box, float lensScale) {
    const vec2 farthest = glm::max(glm::abs(box.min), glm::abs(box.max)), width = box.max - box.min;
    const float radius = std::min(std::sqrt(farthest.x * farthest.x + farthest.y * farthest.y), lensScale);
    return {radius, radius, std::max(width.x, width.y), 1};
}

ListClass classOfList(const Bins& bins, std::span<const uint> bricks, const LensSight& sight, vec2 times,
                      const MapLayout& map) {
    ListClass listClass;
    ClassifyKernels kernels{bins, bricks, map, listClass.clusters};
    const uint code = bins.motion.moves() ? kernels.movingClassOf(0, uint(bricks.size()), sight, times)
                                          : kernels.classOf(0, uint(bricks.size()), sight);
    listClass.inFocus = (code & kInFocusBit) != 0;
    listClass.sparse = (code & kSparseBit) != 0;
    if ((code & (kInFocusBit - 1)) == 0) listClass.clusters.clear();
    return listClass;
}

std::vector<vec4> lensPoints(const OutputPattern& pattern) {
    // Cells twice as high as wide: with every other column half a cell lower, points are as far from their
    // neighbours in all directions.
    const float stagger = pattern.lensCells.x > pattern.lensCells.y ? 0.25f : 0.f;
    std::vector<vec4> points;
    for (const glm::uvec4& entry : pattern.entries) {
        const vec2 middle = vec2(lensCell(entry)) + 0.5f;
        const vec2 cell = middle + vec2(0, (entry.w & 1u) != 0 ? stagger : -stagger);
        const vec2 uv = pattern.lensScale * pattern.aperture.at(cell * (2.f / vec2(pattern.lensCells)) - 1.f);
        const float part = (float(entry.z) + 0.5f) / float(pattern.outputsPerPixel());
        const float t = pattern.shutter.open + pattern.shutter.span * part;
        points.emplace_back(uv, pattern.shutter.moves ? t - 0.5f : 0.f, 0);
    }
    return points;
}

float spreadPerPx(const OutputPattern& pattern) {
    const float area = std::numbers::pi_v<float> * float(pattern.aperture.meanTransmission());
    return pattern.lensScale * std::sqrt(area / float(pattern.outputsPerPixel()));
}

std::optional<vec3> lookThrough(const LayerMap& map, std::span<const Cluster> clusters, vec2 x, vec2 uv,
                                float time) {
    vec3 sum(0);
    const auto look = [&](auto kernels) { return kernels.look({x, uv, time}, 0, int(clusters.size()), sum); };
    const bool moves = !map.motions.empty();
    const bool met = map.distortion.empty() ? moves ? look(LookupKernels<true, false>{map, clusters})
                                                    : look(LookupKernels<false, false>{map, clusters})
                     : moves ? look(LookupKernels<true, true>{map, clusters})
                                            : look(LookupKernels<false, true>{map, clusters});
    if (!met) return {};
    return sum;
}

} // namespace slant

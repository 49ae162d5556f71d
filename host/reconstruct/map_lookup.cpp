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

    const Brick& listedBrick(uint entry) const { return bins.bricks[bricks[entry]]; }
    void keepCluster(uint, const Cluster& cluster) { clusters.push_back(cluster); }
#include "lib/classify.glsl"
};

struct LookupKernels {
    const std::vector<glm::uvec4>& texels;
    std::span<const Cluster> clusters;
    const MapLayout& mapLayout;

    const uvec4& mapTexelAt(int i) const { return texels[std::size_t(i)]; }
    const Cluster& clusterAt(int i) const { return clusters[std::size_t(i)]; }
#include "lib/map_lookup.glsl"
};

} // namespace

ListClass classOfList(const Bins& bins, std::span<const uint> bricks, const LensBox& lens, float lensScale,
                      const MapLayout& map) {
    ListClass listClass;
    const uint code = ClassifyKernels{bins, bricks, map, listClass.clusters}.classOf(
        0, uint(bricks.size()), vec4(lens.min, lens.max), lensScale);
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
        points.emplace_back(uv, 0, 0);
    }
    return points;
}

float spreadPerPx(const OutputPattern& pattern) {
    const float area = std::numbers::pi_v<float> * float(pattern.aperture.meanTransmission());
    return pattern.lensScale * std::sqrt(area / float(pattern.outputsPerPixel()));
}

std::optional<vec3> lookThrough(const LayerMap& map, std::span<const Cluster> clusters, vec2 x, vec2 uv) {
    vec3 sum(0);
    if (!LookupKernels{map.texels, clusters, map.layout}.look(x, uv, 0, int(clusters.size()), sum)) return {};
    return sum;
}

} // namespace slant

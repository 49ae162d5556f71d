#include "reconstruct/map_lookup.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace slant {
namespace {

/// Lookups of one cluster in one level of the map.
struct Lookup {
    const LayerMap& map;
    float low, high; ///< slopes of the cluster, and half a gap to each side
    ivec2 size;      ///< of the level
    ivec2 origin;    ///< its first texel
    std::size_t begin;
    float scale; ///< texels a pixel

    bool fits(float slope) const { return slope >= low && slope <= high; }
    /// The foremost layer of a texel, counted from raster position 0, that belongs to the cluster; false
    /// without one.
    bool layerAt(ivec2 place, MapLayer& layer) const {
        const ivec2 texel = place - origin;
        if (texel.x < 0 || texel.y < 0 || texel.x >= size.x || texel.y >= size.y) return false;
        const MapTexel found =
            unpackTexel(map.texels[begin + std::size_t(texel.y) * size.x + texel.x], map.layout.code);
        for (const MapLayer& candidate : found.layers)
            if (fits(candidate.slope)) {
                layer = candidate;
                return true;
            }
        return false;
    }
    ivec2 placeAt(vec2 x, vec2 uv, float slope) const { return ivec2(glm::floor((x - slope * uv) * scale)); }
};

Lookup lookUp(const LayerMap& map, const Cluster& cluster) {
    const float gap = 0.5f * map.layout.surfaceGap;
    const int level = int(cluster.level);
    return {map,
            cluster.slopeMin - gap,
            cluster.slopeMax + gap,
            levelSize(map.layout, level),
            map.layout.texelsPerPixel * map.layout.origin / (1 << level),
            levelBegin(map.layout, level),
            float(map.layout.texelsPerPixel) / float(1 << level)};
}

/// Follows the ray x - slope * uv from a few slopes of the cluster to where the map has that slope.
float settle(const Lookup& lookup, const Cluster& cluster, vec2 x, vec2 uv) {
    const vec3 starts(0.5f * (cluster.slopeMin + cluster.slopeMax), cluster.slopeMax, cluster.slopeMin);
    const float spread = (cluster.slopeMax - cluster.slopeMin) * glm::max(glm::abs(uv.x), glm::abs(uv.y));
    const int last = spread * lookup.scale < 1 ? 0 : 2; // within a texel one start is as good as three
    MapLayer layer;
    for (int start = 0; start <= last; ++start) {
        layer.slope = starts[start];
        ivec2 place = lookup.placeAt(x, uv, layer.slope);
        bool met = false;
        for (int step = 0; step < kSettleSteps && lookup.layerAt(place, layer); ++step) {
            met = true;
            const ivec2 next = lookup.placeAt(x, uv, layer.slope);
            if (next == place) break;
            place = next;
        }
        if (met) break;
    }
    return layer.slope;
}

/// The layer around a place, interpolated: radiance times coverage, coverage.
vec4 layerAround(const Lookup& lookup, vec2 place) {
    const vec2 corner = glm::floor(place - 0.5f), part = place - 0.5f - corner;
    vec4 sum(0);
    for (int i = 0; i < 4; ++i) {
        const ivec2 step(i & 1, i >> 1);
        MapLayer layer;
        if (!lookup.layerAt(ivec2(corner) + step, layer)) continue;
        const float weight =
            (step.x == 1 ? part.x : 1.f - part.x) * (step.y == 1 ? part.y : 1.f - part.y) * layer.coverage;
        sum += vec4(weight * layer.rgb, weight);
    }
    return sum;
}

/// Level of the map where lens positions are near enough to one another on a surface of this slope or more.
float levelFor(float slope, const MapLayout& map) {
    float spacing = float(map.texelsPerPixel) * map.spreadPerPx * glm::max(slope, 0.f);
    int level = 0;
    for (; level + 1 < map.levels && spacing >= kLevelSpacing; ++level) spacing *= 0.5f;
    return float(level);
}

} // namespace

ListClass classOfList(const Bins& bins, std::span<const uint> bricks, const LensBox& lens, float lensScale,
                      const MapLayout& map) {
    const vec2 farthest = glm::max(glm::abs(lens.min), glm::abs(lens.max));
    const float lensRadius =
        glm::min(glm::sqrt(farthest.x * farthest.x + farthest.y * farthest.y), lensScale);
    const float lensWidth = glm::max(lens.max.x - lens.min.x, lens.max.y - lens.min.y);
    ListClass listClass;
    listClass.sparse = !bricks.empty() && bricks.size() <= std::size_t(kMaxLoopIterations);
    float finest = 1; ///< own radius, over R
    bool fits = bricks.size() <= std::size_t(kMaxLoopIterations);
    vec2 open(std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity());
    const auto close = [&] {
        const float least = glm::max(open.x, -open.y); // to either side
        const float most = glm::max(-open.x, open.y), reach = most * lensRadius;
        listClass.sparse = listClass.sparse && most * lensWidth <= kSparsePx;
        listClass.inFocus = listClass.inFocus || least < kMinSlope;
        fits = fits && reach <= map.reachPx && (open.y - open.x) * lensRadius <= kWidestClusterPx &&
               listClass.clusters.size() < kMaxClusters;
        listClass.clusters.push_back({open.x, open.y, levelFor(least, map)});
    };
    for (std::size_t i = 0; i < bricks.size(); ++i) {
        const Brick& brick = bins.bricks[bricks[i]];
        finest = glm::min(finest, widestRadius(brick));
        if (i > 0 && brick.slopeMin > open.y + bins.grid.surfaceGap) {
            close();
            open = {brick.slopeMin, brick.slopeMax};
        }
        open = {glm::min(open.x, brick.slopeMin), glm::max(open.y, brick.slopeMax)};
    }
    if (!bricks.empty()) close();
    const bool tooCoarse = finest * map.radiusPx * float(map.texelsPerPixel) < 1;
    if (!fits || (listClass.inFocus && (tooCoarse || listClass.clusters.size() > kMaxInFocusClusters)))
        listClass.clusters.clear();
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
    vec3 rgb(0), last(0);
    float transmittance = 1;
    for (const Cluster& cluster : clusters) {
        const Lookup lookup = lookUp(map, cluster);
        const float slope = settle(lookup, cluster, x, uv);
        const vec4 layer = layerAround(lookup, (x - slope * uv) * lookup.scale);
        if (!(layer.w > 0)) continue;
        rgb += transmittance * vec3(layer);
        transmittance *= 1 - layer.w;
        last = vec3(layer) / layer.w;
        if (transmittance < kOpaque) break;
    }
    if (transmittance == 1.f) return {};
    return rgb + transmittance * last;
}

} // namespace slant

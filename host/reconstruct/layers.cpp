#include "reconstruct/layers.h"

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

    /// The foremost layer of a texel, counted from raster position 0, that belongs to the cluster; -1 without
    /// one.
    int layerAt(ivec2 place, std::size_t& index, float& slope) const {
        const ivec2 texel = place - origin;
        if (texel.x < 0 || texel.y < 0 || texel.x >= size.x || texel.y >= size.y) return -1;
        index = begin + std::size_t(texel.y) * size.x + texel.x;
        const vec4& head = map.heads[index];
        for (int i = 0; i < kMapLayers; ++i)
            if (head[i] >= low && head[i] <= high) {
                slope = head[i];
                return i;
            }
        return -1;
    }
};

Lookup lookUp(const LayerMap& map, const Cluster& cluster) {
    const float gap = 0.5f * map.layout.surfaceGap;
    // The least slope to either side.
    float spacing = float(kMapTexels) * map.layout.spreadPerPx *
                    glm::max(glm::max(cluster.slopeMin, -cluster.slopeMax), 0.f);
    Lookup lookup{
        map, cluster.slopeMin - gap, cluster.slopeMax + gap, map.layout.size, kMapTexels * map.layout.origin,
        0,   float(kMapTexels)};
    for (int level = 1; level < map.layout.levels && spacing >= kLevelSpacing; ++level) {
        lookup.begin += std::size_t(lookup.size.x) * lookup.size.y;
        lookup.size /= 2;
        lookup.origin /= 2;
        lookup.scale *= 0.5f;
        spacing *= 0.5f;
    }
    return lookup;
}

/// Follows the ray x - slope * uv from a few slopes of the cluster to where the map has that slope.
float settle(const Lookup& lookup, const Cluster& cluster, vec2 x, vec2 uv) {
    const vec3 starts(0.5f * (cluster.slopeMin + cluster.slopeMax), cluster.slopeMax, cluster.slopeMin);
    float slope = starts.x;
    for (int start = 0; start < 3; ++start) {
        slope = starts[start];
        bool met = false;
        for (int step = 0; step < 3; ++step) {
            std::size_t texel = 0;
            if (lookup.layerAt(ivec2(glm::floor((x - slope * uv) * lookup.scale)), texel, slope) < 0) break;
            met = true;
        }
        if (met) break;
    }
    return slope;
}

/// The layer around a place, interpolated: radiance times coverage, coverage.
vec4 layerAround(const Lookup& lookup, vec2 place) {
    const vec2 corner = glm::floor(place - 0.5f), part = place - 0.5f - corner;
    vec4 sum(0);
    for (int i = 0; i < 4; ++i) {
        const ivec2 step(i & 1, i >> 1);
        std::size_t texel = 0;
        float slope = 0;
        const int layer = lookup.layerAt(ivec2(corner) + step, texel, slope);
        if (layer < 0) continue;
        const vec4& value = lookup.map.layers[texel * kMapLayers + layer];
        const float weight =
            (step.x == 1 ? part.x : 1.f - part.x) * (step.y == 1 ? part.y : 1.f - part.y) * value.w;
        sum += vec4(weight * vec3(value), weight);
    }
    return sum;
}

} // namespace

std::vector<Cluster> clustersOf(const Bins& bins, std::span<const uint> bricks, const LensBox& lens,
                                float lensScale, float reachPx) {
    const vec2 farthest = glm::max(glm::abs(lens.min), glm::abs(lens.max));
    const float lensRadius =
        glm::min(glm::sqrt(farthest.x * farthest.x + farthest.y * farthest.y), lensScale);
    std::vector<Cluster> clusters;
    bool fits = bricks.size() <= std::size_t(kMaxLoopIterations);
    Cluster open{std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()};
    const auto close = [&] {
        const bool inFocus = glm::max(open.slopeMin, -open.slopeMax) < kLeastSlope;
        const float reach = glm::max(-open.slopeMin, open.slopeMax) * lensRadius;
        fits = fits && !inFocus && reach <= reachPx &&
               (open.slopeMax - open.slopeMin) * lensRadius <= kWidestClusterPx &&
               clusters.size() < kMaxClusters;
        clusters.push_back(open);
    };
    for (std::size_t i = 0; i < bricks.size(); ++i) {
        const Brick& brick = bins.bricks[bricks[i]];
        if (i > 0 && brick.slopeMin > open.slopeMax + bins.grid.surfaceGap) {
            close();
            open = {brick.slopeMin, brick.slopeMax};
        }
        open = {glm::min(open.slopeMin, brick.slopeMin), glm::max(open.slopeMax, brick.slopeMax)};
    }
    if (!bricks.empty()) close();
    return fits ? clusters : std::vector<Cluster>{};
}

std::vector<vec4> lensPoints(const OutputPattern& pattern) {
    std::vector<vec4> points;
    for (const glm::uvec4& entry : pattern.entries) {
        const vec2 cell = vec2(float(entry.w & 0xffffu), float(entry.w >> 16)) + 0.5f;
        const vec2 uv = pattern.lensScale * pattern.aperture.at(cell * (2.f / vec2(pattern.lensCells)) - 1.f);
        points.emplace_back(uv, 0, 0);
    }
    return points;
}

float spreadPerPx(const OutputPattern& pattern) {
    const float area = std::numbers::pi_v<float> * float(pattern.aperture.meanTransmission());
    return pattern.lensScale * std::sqrt(area / float(pattern.outputsPerPixel()));
}

std::optional<vec3> throughLayers(const LayerMap& map, std::span<const Cluster> clusters, vec2 pixelCenter,
                                  std::span<const vec4> points) {
    vec3 mean(0);
    for (const vec4& point : points) {
        const vec2 uv(point.x, point.y);
        vec3 rgb(0), last(0);
        float transmittance = 1;
        for (const Cluster& cluster : clusters) {
            const Lookup lookup = lookUp(map, cluster);
            const float slope = settle(lookup, cluster, pixelCenter, uv);
            const vec4 layer = layerAround(lookup, (pixelCenter - slope * uv) * lookup.scale);
            if (!(layer.w > 0)) continue;
            rgb += transmittance * vec3(layer);
            transmittance *= 1 - layer.w;
            last = vec3(layer) / layer.w;
            if (transmittance < kOpaque) break;
        }
        if (transmittance == 1.f) return {};
        mean += rgb + transmittance * last;
    }
    return mean / float(points.size());
}

void addMapShare(std::vector<float>& share, const Rect& frame, const Band& band, std::span<const uint> rungs,
                 std::size_t groups) {
    share.resize(frame.area());
    const std::size_t columns = std::size_t(band.region.width() + kTileSize - 1) / kTileSize;
    const std::size_t tiles = columns * (std::size_t(band.region.height() + kTileSize - 1) / kTileSize);
    for (int y = band.y0; y < band.y1; ++y)
        for (int x = frame.x0; x < frame.x1; ++x) {
            const std::size_t row = std::size_t(y - band.region.y0) / kTileSize,
                              column = std::size_t(x - band.region.x0) / kTileSize;
            float& sum = share[std::size_t(y - frame.y0) * frame.width() + (x - frame.x0)];
            for (std::size_t list = row * columns + column; list < rungs.size(); list += tiles)
                if (rungs[list] != 0) sum += 1 / float(groups);
        }
}

} // namespace slant

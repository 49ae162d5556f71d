// What is seen at a place through a lens position, from the layer map (host/reconstruct/map_lookup.h).
//
// Needs, declared before the include: mapTexelAt(int), which reads the map, and clusterAt(int), which reads
// clusters; and mapLayout. In C++ it is included in a struct that has these, after lib/map_texel.glsl and
// lib/trajectory.glsl.
#include "lib/map_texel.glsl"
#include "lib/trajectory.glsl"

/// Lookups of one cluster in one level of the map.
struct Lookup {
    float low, high; // slopes of the cluster, and half a gap to each side
    ivec2 size;      // of the level
    ivec2 origin;    // its first texel
    int begin;
    float scale; // texels per pixel
    SlopeCode code;
};

KERNEL Lookup lookUp(IN(Cluster) cluster) {
    const float gap = 0.5f * mapLayout.surfaceGap;
    const int level = int(cluster.level), base = mapLayout.size.x * mapLayout.size.y;
    const Lookup lookup = {cluster.slopeMin - gap,
                           cluster.slopeMax + gap,
                           mapLayout.size >> level,
                           mapLayout.texelsPerPixel * mapLayout.origin >> level,
                           (base - (base >> 2 * level)) / 3 * 4, // 1 + 1/4 + ... of the levels below
                           float(mapLayout.texelsPerPixel) * powerOfTwo(kFloatBias - uint(level)),
                           mapLayout.code};
    return lookup;
}

KERNEL bool fits(IN(Lookup) lookup, float slope) {
    return slope >= lookup.low && slope <= lookup.high;
}

/// The foremost layer of a texel, counted from raster position 0, that belongs to the cluster; false without
/// one.
KERNEL bool layerAt(IN(Lookup) lookup, ivec2 place, INOUT(uvec2) words, INOUT(float) slope) {
    const ivec2 inMap = place - lookup.origin;
    const bool inside = uint(inMap.x) < uint(lookup.size.x) && uint(inMap.y) < uint(lookup.size.y);
    IN(uvec4) texel = mapTexelAt(inside ? lookup.begin + inMap.y * lookup.size.x + inMap.x : 0);
    const float front = unpackSlope(texel.y, lookup.code), back = unpackSlope(texel.w, lookup.code);
    const bool isFront = fits(lookup, front), found = inside && (isFront || fits(lookup, back));
    if (found) {
        words = isFront ? uvec2(texel) : uvec2(texel.z, texel.w);
        slope = isFront ? front : back;
    }
    return found;
}

KERNEL ivec2 placeAt(IN(Lookup) lookup, vec2 x, vec2 uv, float slope) {
    return ivec2(floor(pinholeOf(x, uv, slope) * lookup.scale));
}

/// Follows the ray through x and uv, from a few slopes of the cluster, to a place where the map has the
/// slope that led there. The loops test for their end last, since lavapipe executes the rest of an iteration
/// that all invocations have left.
KERNEL float settle(IN(Lookup) lookup, IN(Cluster) cluster, vec2 x, vec2 uv) {
    const vec3 starts =
        vec3(0.5f * (cluster.slopeMin + cluster.slopeMax), cluster.slopeMax, cluster.slopeMin);
    const float spread = (cluster.slopeMax - cluster.slopeMin) * max(abs(uv.x), abs(uv.y));
    const int last = spread * lookup.scale < 1.0f ? 0 : 2; // within a texel one start is enough
    uvec2 words;
    for (int start = 0;; ++start) {
        float slope = starts[start];
        ivec2 place = placeAt(lookup, x, uv, slope);
        bool met = false;
        for (int step_ = 1;; ++step_) {
            const bool found = layerAt(lookup, place, words, slope);
            met = met || found;
            const ivec2 next = placeAt(lookup, x, uv, slope);
            if (!found || next == place || step_ == kSettleSteps) break;
            place = next;
        }
        if (met || start == last) return slope;
    }
}

/// The layer around a place, interpolated: radiance times coverage, coverage.
KERNEL vec4 layerAround(IN(Lookup) lookup, vec2 place) {
    const vec2 corner = floor(place - 0.5f), part = place - 0.5f - corner;
    vec4 sum = vec4(0.0f);
    for (int i = 0; i < 4; ++i) {
        const ivec2 step_ = ivec2(i & 1, i >> 1);
        uvec2 words;
        float slope;
        if (!layerAt(lookup, ivec2(corner) + step_, words, slope)) continue;
        const vec4 layer = unpackLayer(words);
        const float weight =
            (step_.x == 1 ? part.x : 1.0f - part.x) * (step_.y == 1 ? part.y : 1.0f - part.y) * layer.w;
        sum += vec4(weight * vec3(layer), weight);
    }
    return sum;
}

/// What is seen at raster position x through one lens position, added to `sum`; false if no surface is met.
KERNEL bool look(vec2 x, vec2 uv, int clusterBegin, int clusterCount, INOUT(vec3) sum) {
    vec3 rgb = vec3(0.0f), last = vec3(0.0f);
    float transmittance = 1.0f;
    for (int i = 0; i < clusterCount; ++i) {
        IN(Cluster) cluster = clusterAt(clusterBegin + i);
        const Lookup lookup = lookUp(cluster);
        const float slope = settle(lookup, cluster, x, uv);
        const vec4 layer = layerAround(lookup, pinholeOf(x, uv, slope) * lookup.scale);
        if (!(layer.w > 0.0f)) continue;
        rgb += transmittance * vec3(layer);
        transmittance *= 1.0f - layer.w;
        last = vec3(layer) / layer.w;
        if (transmittance < kOpaque) break;
    }
    sum += rgb + transmittance * last;
    return transmittance != 1.0f;
}

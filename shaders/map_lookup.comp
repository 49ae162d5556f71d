#version 460
// The outputs of lists that the layer map serves: one invocation takes all those of a pixel. Where one of them meets
// nothing, the pixel is left to reconstruct.comp, or the whole list. As host/reconstruct/map_lookup.cpp.
#extension GL_GOOGLE_include_directive : require
#include "lib/map_texel.glsl"
#include "lib/output.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform utextureBuffer listStart;
layout(set = 0, binding = 1) uniform textureBuffer clusters;
layout(set = 0, binding = 2) uniform utextureBuffer texels;
layout(set = 0, binding = 3) uniform textureBuffer lensPoints;
layout(set = 0, binding = 4) uniform utextureBuffer pattern;
layout(set = 0, binding = 5) uniform utextureBuffer classes;
layout(set = 0, binding = 6, rgba32f) uniform writeonly imageBuffer dense;
layout(set = 0, binding = 7, r32ui) uniform uimageBuffer missed; // two a list: a bit for each pixel
layout(push_constant) uniform Push { MapLookupPush push; };

struct Lookup {
    float low, high; // slopes of the cluster, and half a gap to each side
    ivec2 size;      // of the level
    ivec2 origin;    // its first texel
    int begin;
    float scale; // texels a pixel
    SlopeCode code;
};

Lookup lookUp(vec3 cluster) {
    const float gap = 0.5 * push.map.surfaceGap;
    const int level = int(cluster.z), base = push.map.size.x * push.map.size.y;
    return Lookup(cluster.x - gap, cluster.y + gap, push.map.size >> level, push.map.texelsPerPixel * push.map.origin >> level,
                  4 * (base - (base >> 2 * level)) / 3, float(push.map.texelsPerPixel) * powerOfTwo(kFloatBias - uint(level)),
                  push.map.code);
}

bool fits(Lookup lookup, float slope) { return slope >= lookup.low && slope <= lookup.high; }

/// The foremost layer of a texel, counted from raster position 0, that belongs to the cluster; false without one.
bool layerAt(Lookup lookup, ivec2 place, inout uvec2 words, inout float slope) {
    const ivec2 inMap = place - lookup.origin;
    const bool inside = uint(inMap.x) < uint(lookup.size.x) && uint(inMap.y) < uint(lookup.size.y);
    const uvec4 texel = texelFetch(texels, inside ? lookup.begin + inMap.y * lookup.size.x + inMap.x : 0);
    const float front = unpackSlope(texel.y, lookup.code), back = unpackSlope(texel.w, lookup.code);
    const bool isFront = fits(lookup, front), found = inside && (isFront || fits(lookup, back));
    if (found) {
        words = isFront ? texel.xy : texel.zw;
        slope = isFront ? front : back;
    }
    return found;
}

ivec2 placeAt(Lookup lookup, vec2 x, vec2 uv, float slope) { return ivec2(floor((x - slope * uv) * lookup.scale)); }

/// Follows the ray x - slope * uv from a few slopes of the cluster to where the map has that slope. The loops end at
/// their ends, since lavapipe goes through the rest of a round that all invocations have left.
float settle(Lookup lookup, vec2 cluster, vec2 x, vec2 uv) {
    const vec3 starts = vec3(0.5 * (cluster.x + cluster.y), cluster.y, cluster.x);
    const float spread = (cluster.y - cluster.x) * max(abs(uv.x), abs(uv.y));
    const int last = spread * lookup.scale < 1.0 ? 0 : 2; // within a texel one start is as good as three
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
vec4 layerAround(Lookup lookup, vec2 place) {
    const vec2 corner = floor(place - 0.5), part = place - 0.5 - corner;
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 4; ++i) {
        const ivec2 step_ = ivec2(i & 1, i >> 1);
        uvec2 words;
        float slope;
        if (!layerAt(lookup, ivec2(corner) + step_, words, slope)) continue;
        const vec4 layer = unpackLayer(words);
        const float weight = (step_.x == 1 ? part.x : 1.0 - part.x) * (step_.y == 1 ? part.y : 1.0 - part.y) * layer.w;
        sum += vec4(weight * layer.rgb, weight);
    }
    return sum;
}

/// What is seen from x through one lens position, added to `sum`; false if nothing.
bool look(vec2 x, vec2 uv, int clusterBegin, uint clusterCount, inout vec3 sum) {
    vec3 rgb = vec3(0.0), last = vec3(0.0);
    float transmittance = 1.0;
    for (uint i = 0u; i < clusterCount; ++i) {
        const vec3 cluster = texelFetch(clusters, clusterBegin + int(i)).xyz;
        const Lookup lookup = lookUp(cluster);
        const float slope = settle(lookup, cluster.xy, x, uv);
        const vec4 layer = layerAround(lookup, (x - slope * uv) * lookup.scale);
        if (!(layer.w > 0.0)) continue;
        rgb += transmittance * layer.rgb;
        transmittance *= 1.0 - layer.w;
        last = layer.rgb / layer.w;
        if (transmittance < kOpaque) break;
    }
    sum += rgb + transmittance * last;
    return transmittance != 1.0;
}

/// Leaves this pixel to the bins, or all of the list.
void miss(int list, uint clusterCount) {
    const bool whole = clusterCount > kPartClusters;
    const uint word = gl_LocalInvocationIndex >> 5, bit = 1u << (gl_LocalInvocationIndex & 31u);
    imageAtomicOr(missed, 2 * list + int(word), whole ? ~0u : bit);
    if (whole) imageAtomicOr(missed, 2 * list + 1 - int(word), ~0u);
}

void main() {
    const uvec3 tile = gl_WorkGroupID;
    const ivec2 position = ivec2(gl_GlobalInvocationID.xy), size = push.outputs.regionSize;
    const int list = (int(tile.z) * push.outputs.tileCount.y + int(tile.y)) * push.outputs.tileCount.x + int(tile.x);
    const uint listClass = texelFetch(classes, list).x, clusterCount = listClass & (kInFocusBit - 1u);
    if (clusterCount == 0u) return;
    const bool inFocus = (listClass & kInFocusBit) != 0u, sparse = (listClass & kSparseBit) != 0u;
    const int groupSize = 1 << push.groupBits, taken = sparse ? 1 << push.sparseBits : groupSize;
    const int clusterBegin = int(texelFetch(listStart, list).x);
    const int firstOutput = (int(push.firstGroup) + int(tile.z)) * groupSize, firstPlane = int(tile.z) * groupSize;
    const ivec2 pixel = push.outputs.regionOrigin + position;
    // Positions outside the region are looked at too: whether a list is served must not depend on bands.
    const bool inRegion = position.x < size.x && position.y < size.y;
    vec3 sum = vec3(0.0);
    for (int rank = 0; rank < groupSize; ++rank) {
        if (rank >= taken && !inFocus) break;
        const int i = sparse ? int(inOrder(texelFetch(pattern, firstOutput + rank))) : rank;
        vec4 value = vec4(vec3(0.0), kLeftOut);
        if (rank < taken) {
            Output o = outputOnFilm(vec2(pixel) + 0.5, vec2(0.0), 0.0, kWholePixel);
            if (inFocus) {
                o = placed(pixel, texelFetch(pattern, firstOutput + i), seedOf(pixel, push.outputs.seed));
                sum = vec3(0.0);
            }
            if (!look(o.xy, texelFetch(lensPoints, firstOutput + i).xy, clusterBegin, clusterCount, sum)) {
                miss(list, clusterCount);
                return;
            }
            value = vec4(sum, o.positionCode);
        }
        if (inFocus && inRegion)
            imageStore(dense, ((firstPlane + i) * size.y + position.y) * size.x + position.x, value);
    }
    if (!inFocus && inRegion)
        imageStore(dense, (firstPlane * size.y + position.y) * size.x + position.x, vec4(sum / float(taken), kWholePixel));
}

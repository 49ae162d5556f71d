#version 460
// The outputs of lists that the layer map serves: one invocation takes all those of a pixel. A list in which one of
// them meets nothing is left to reconstruct.comp. As throughLayers of host/reconstruct/layers.cpp.
#extension GL_GOOGLE_include_directive : require
#include "shared/layers.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform utextureBuffer listStart;
layout(set = 0, binding = 1) uniform textureBuffer clusters;
layout(set = 0, binding = 2) uniform textureBuffer heads;
layout(set = 0, binding = 3) uniform textureBuffer layers;
layout(set = 0, binding = 4) uniform textureBuffer lensPoints;
layout(set = 0, binding = 5, r32ui) uniform uimageBuffer rungs;
layout(set = 0, binding = 6, rgba32f) uniform writeonly imageBuffer dense;
layout(push_constant) uniform Push { LayerPush push; };

struct Lookup {
    float low, high; // slopes of the cluster, and half a gap to each side
    ivec2 size;      // of the level
    ivec2 origin;    // its first texel
    int begin;
    float scale; // texels a pixel
};

/// The foremost layer of a texel, counted from raster position 0, that belongs to the cluster: its place in `layers`, -1
/// without one.
int layerAt(Lookup lookup, ivec2 place, inout float slope) {
    const ivec2 inMap = place - lookup.origin;
    if (inMap.x < 0 || inMap.y < 0 || inMap.x >= lookup.size.x || inMap.y >= lookup.size.y) return -1;
    const int texel = lookup.begin + inMap.y * lookup.size.x + inMap.x;
    const vec4 head = texelFetch(heads, texel);
    const bvec3 fits = bvec3(head.x >= lookup.low && head.x <= lookup.high, head.y >= lookup.low && head.y <= lookup.high,
                             head.z >= lookup.low && head.z <= lookup.high);
    if (!any(fits)) return -1;
    slope = fits.x ? head.x : fits.y ? head.y : head.z;
    return texel * kMapLayers + (fits.x ? 0 : fits.y ? 1 : 2);
}

Lookup lookUp(vec2 cluster) {
    const float gap = 0.5 * push.map.surfaceGap;
    float spacing = float(kMapTexels) * push.map.spreadPerPx * max(max(cluster.x, -cluster.y), 0.0);
    Lookup lookup = Lookup(cluster.x - gap, cluster.y + gap, push.map.size, kMapTexels * push.map.origin, 0, float(kMapTexels));
    for (int level = 1; level < push.map.levels && spacing >= kLevelSpacing; ++level) {
        lookup.begin += lookup.size.x * lookup.size.y;
        lookup.size /= 2;
        lookup.origin /= 2;
        lookup.scale *= 0.5;
        spacing *= 0.5;
    }
    return lookup;
}

float settle(Lookup lookup, vec2 cluster, vec2 x, vec2 uv) {
    const vec3 starts = vec3(0.5 * (cluster.x + cluster.y), cluster.y, cluster.x);
    float slope = starts.x;
    for (int start = 0; start < 3; ++start) {
        slope = starts[start];
        bool met = false;
        for (int step_ = 0; step_ < 3; ++step_) {
            if (layerAt(lookup, ivec2(floor((x - slope * uv) * lookup.scale)), slope) < 0) break;
            met = true;
        }
        if (met) break;
    }
    return slope;
}

vec4 layerAround(Lookup lookup, vec2 place) {
    const vec2 corner = floor(place - 0.5), part = place - 0.5 - corner;
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 4; ++i) {
        const ivec2 step_ = ivec2(i & 1, i >> 1);
        float slope = 0.0;
        const int layer = layerAt(lookup, ivec2(corner) + step_, slope);
        if (layer < 0) continue;
        const vec4 value = texelFetch(layers, layer);
        const float weight = (step_.x == 1 ? part.x : 1.0 - part.x) * (step_.y == 1 ? part.y : 1.0 - part.y) * value.w;
        sum += vec4(weight * value.rgb, weight);
    }
    return sum;
}

/// What is seen through one lens position; false if nothing.
bool look(vec2 x, vec2 uv, int clusterBegin, uint clusterCount, inout vec3 mean) {
    vec3 rgb = vec3(0.0), last = vec3(0.0);
    float transmittance = 1.0;
    for (uint i = 0u; i < clusterCount; ++i) {
        const int place = clusterBegin + 2 * int(i);
        const vec2 cluster = vec2(texelFetch(clusters, place).x, texelFetch(clusters, place + 1).x);
        const Lookup lookup = lookUp(cluster);
        const float slope = settle(lookup, cluster, x, uv);
        const vec4 layer = layerAround(lookup, (x - slope * uv) * lookup.scale);
        if (!(layer.w > 0.0)) continue;
        rgb += transmittance * layer.rgb;
        transmittance *= 1.0 - layer.w;
        last = layer.rgb / layer.w;
        if (transmittance < kOpaque) break;
    }
    mean += rgb + transmittance * last;
    return transmittance != 1.0;
}

void main() {
    const uvec3 tile = gl_WorkGroupID;
    const ivec2 position = ivec2(gl_GlobalInvocationID.xy), size = push.outputs.regionSize;
    const int list = (int(tile.z) * push.outputs.tileCount.y + int(tile.y)) * push.outputs.tileCount.x + int(tile.x);
    const uint clusterCount = imageLoad(rungs, list).x;
    if (clusterCount == 0u) return;
    const int groupSize = 1 << push.groupBits;
    const int clusterBegin = 2 * int(texelFetch(listStart, list).x);
    const int firstPoint = (int(push.firstGroup) + int(tile.z)) * groupSize;
    const vec2 x = vec2(push.outputs.regionOrigin + position) + 0.5;
    vec3 mean = vec3(0.0);
    for (int i = 0; i < groupSize; ++i)
        if (!look(x, texelFetch(lensPoints, firstPoint + i).xy, clusterBegin, clusterCount, mean)) {
            imageStore(rungs, list, uvec4(0u));
            return;
        }
    // Positions outside the region are looked at too: whether a list is served must not depend on bands.
    if (position.x >= size.x || position.y >= size.y) return;
    const int plane = int(tile.z) * groupSize;
    imageStore(dense, (plane * size.y + position.y) * size.x + position.x, vec4(mean / float(groupSize), kWholePixel));
}

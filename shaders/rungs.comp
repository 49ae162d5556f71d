#version 460
// For each list: the clusters of surfaces that it sees, if its outputs can be taken from the layer map. As clustersOf
// of host/reconstruct/layers.cpp.
#extension GL_GOOGLE_include_directive : require
#include "lib/candidate.glsl"
#include "lib/grid.glsl"
#include "lib/invocation.glsl"
#include "shared/layers.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform utextureBuffer listStart;
layout(set = 0, binding = 1) uniform utextureBuffer listBricks;
layout(set = 0, binding = 2) uniform textureBuffer lensBoxes;
layout(set = 0, binding = 3, r32ui) uniform writeonly uimageBuffer rungs;
layout(set = 0, binding = 4, r32f) uniform writeonly imageBuffer clusters; // slopeMin, slopeMax from twice the list's start on
layout(push_constant) uniform Push { LayerPush push; };

struct Clusters {
    uint count;
    bool fits;
    vec2 open; // least and greatest slope
};

void close(inout Clusters found, float lensRadius, uint listBegin) {
    const bool inFocus = max(found.open.x, -found.open.y) < kLeastSlope;
    const float reach = max(-found.open.x, found.open.y) * lensRadius;
    found.fits = found.fits && !inFocus && reach <= push.map.reachPx &&
                 (found.open.y - found.open.x) * lensRadius <= kWidestClusterPx && found.count < kMaxClusters;
    const int place = 2 * int(listBegin + found.count);
    imageStore(clusters, place, vec4(found.open.x));
    imageStore(clusters, place + 1, vec4(found.open.y));
    ++found.count;
}

void main() {
    const uint list = linearInvocation(gl_WorkGroupID, gl_NumWorkGroups, gl_WorkGroupSize, gl_LocalInvocationIndex);
    if (list >= push.count) return;
    const uint tiles = uint(push.outputs.tileCount.x) * uint(push.outputs.tileCount.y);
    const vec4 box = texelFetch(lensBoxes, int(push.firstGroup + list / tiles));
    const vec2 farthest = max(abs(box.xy), abs(box.zw));
    const float lensRadius = min(sqrt(farthest.x * farthest.x + farthest.y * farthest.y), push.lensScale);
    const uint begin = texelFetch(listStart, int(list)).x, end = texelFetch(listStart, int(list) + 1).x;
    Clusters found = Clusters(0u, true, vec2(kInfinity, -kInfinity));
    const uint last = min(end, begin + uint(kMaxLoopIterations));
    for (uint entry = begin; entry < last; ++entry) {
        const Brick brick = brickOf(texelFetch(listBricks, int(entry)));
        if (entry > begin && brick.slopeMin > found.open.y + push.map.surfaceGap) {
            close(found, lensRadius, begin);
            found.open = vec2(brick.slopeMin, brick.slopeMax);
        }
        found.open = vec2(min(found.open.x, brick.slopeMin), max(found.open.y, brick.slopeMax));
    }
    if (end > begin) close(found, lensRadius, begin);
    imageStore(rungs, int(list), uvec4(found.fits && last == end ? found.count : 0u));
}

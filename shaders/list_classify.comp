#version 460
// For each list: the clusters of surfaces that it sees, if its outputs can be taken from the layer map.
#extension GL_GOOGLE_include_directive : require
#include "resources/brick.glsl"
#include "resources/invocation.glsl"
#include "shared/layer_map.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform utextureBuffer listStart;
layout(set = 0, binding = 1) uniform utextureBuffer listBricks;
layout(set = 0, binding = 2) uniform textureBuffer lensBoxes;
layout(set = 0, binding = 3, r32ui) uniform writeonly uimageBuffer classes;
layout(set = 0, binding = 4, rgba32f) uniform writeonly imageBuffer clusters; // from the list's start on
layout(set = 0, binding = 5, r32ui) uniform writeonly uimageBuffer missed;    // two per list
layout(push_constant) uniform Push {
    MapLookupPush push;
};

uint listBegin; // of this invocation's list

#define mapLayout push.map
Brick listedBrick(uint entry) {
    return brickOf(texelFetch(listBricks, int(entry)));
}
void keepCluster(uint i, Cluster cluster) {
    imageStore(clusters, int(listBegin + i), vec4(cluster.slopeMin, cluster.slopeMax, cluster.level, 0.0));
}
#include "lib/classify.glsl"

void main() {
    const uint list =
        linearInvocation(gl_WorkGroupID, gl_NumWorkGroups, gl_WorkGroupSize, gl_LocalInvocationIndex);
    if (list >= push.count) return;
    const uint tiles = uint(push.outputs.tileCount.x) * uint(push.outputs.tileCount.y);
    const vec4 box = texelFetch(lensBoxes, int(push.firstGroup + list / tiles));
    listBegin = texelFetch(listStart, int(list)).x;
    const uint end = texelFetch(listStart, int(list) + 1).x;
    const uint listClass = classOf(listBegin, end, box, push.lensScale);
    imageStore(classes, int(list), uvec4(listClass));
    const uvec4 left = uvec4((listClass & (kInFocusBit - 1u)) != 0u ? 0u : ~0u);
    imageStore(missed, 2 * int(list), left);
    imageStore(missed, 2 * int(list) + 1, left);
}

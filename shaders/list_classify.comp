#version 460
// For each list: the clusters of surfaces that it sees, if its outputs can be taken from the layer map.
#extension GL_GOOGLE_include_directive : require
#include "resources/brick.glsl"
#include "resources/cluster.glsl"
#include "resources/compound_lens.glsl"
#include "resources/invocation.glsl"
#include "resources/moving.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform utextureBuffer listStart;
layout(set = 0, binding = 1) uniform utextureBuffer listBricks;
layout(set = 0, binding = 2) uniform textureBuffer lensSights; // of groups; of lists through a compound lens
layout(set = 0, binding = 3, r32ui) uniform writeonly uimageBuffer classes;
layout(set = 0, binding = 4, rgba32f) uniform imageBuffer clusters;        // from the list's start on
layout(set = 0, binding = 5, r32ui) uniform writeonly uimageBuffer missed; // two per list
layout(set = 0, binding = 6) uniform textureBuffer listMotions;
layout(set = 0, binding = 7) uniform textureBuffer groupTimes; // first, last
layout(set = 0, binding = 8) uniform textureBuffer motionTexels;
layout(push_constant) uniform Push {
    MapLookupPush push;
};

uint listBegin; // of this invocation's list

#define mapLayout push.map
Brick listedBrick(uint entry) {
    return brickOf(texelFetch(listBricks, int(entry)));
}
BrickMotion listedMotion(uint entry) {
    const int i = int(entry) * kBrickMotionTexels;
    return brickMotionOf(texelFetch(listMotions, i), texelFetch(listMotions, i + 1));
}
void keepCluster(uint i, Cluster cluster) {
    const int place = (kMoving ? kClusterTexels : 1) * int(listBegin + i);
    imageStore(clusters, place, slopesOf(cluster));
    if (kMoving) imageStore(clusters, place + 1, velocitiesOf(cluster));
}
Cluster keptCluster(uint i) {
    const int place = kClusterTexels * int(listBegin + i);
    return clusterOf(imageLoad(clusters, place), imageLoad(clusters, place + 1));
}
MotionLayout motionLayout;
#include "lib/classify_moving.glsl"

void main() {
    const uint list =
        linearInvocation(gl_WorkGroupID, gl_NumWorkGroups, gl_WorkGroupSize, gl_LocalInvocationIndex);
    if (list >= push.count) return;
    const uint tiles = uint(push.outputs.tileCount.x) * uint(push.outputs.tileCount.y);
    const int group = int(push.firstGroup + list / tiles);
    const vec4 lens = texelFetch(lensSights, kCompoundLens ? int(list) : group);
    const LensSight sight = LensSight(lens.x, lens.y, lens.z, lens.w);
    listBegin = texelFetch(listStart, int(list)).x;
    const uint end = texelFetch(listStart, int(list) + 1).x;
    uint listClass;
    if (kMoving) {
        motionLayout = READ_MOTION_LAYOUT;
        listClass = movingClassOf(listBegin, end, sight, texelFetch(groupTimes, group).xy);
    } else {
        listClass = classOf(listBegin, end, sight);
    }
    imageStore(classes, int(list), uvec4(listClass));
    const uvec4 left = uvec4((listClass & (kInFocusBit - 1u)) != 0u ? 0u : ~0u);
    imageStore(missed, 2 * int(list), left);
    imageStore(missed, 2 * int(list) + 1, left);
}

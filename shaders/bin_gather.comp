#version 460
// Records in the order of their sorted keys, with the weights of their visibility, and 1 where a new brick
// begins.
#extension GL_GOOGLE_include_directive : require
#include "resources/compound_lens.glsl"
#include "resources/invocation.glsl"
#include "resources/moving.glsl"
#include "shared/reconstruct.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform utextureBuffer keys;
layout(set = 0, binding = 1) uniform utextureBuffer indices;
layout(set = 0, binding = 2) uniform textureBuffer samplePositions; // the last: radius ratio
layout(set = 0, binding = 3) uniform textureBuffer areaExcess;
layout(set = 0, binding = 4, rgba32f) uniform writeonly imageBuffer positions;
layout(set = 0, binding = 5, rgba32f) uniform writeonly imageBuffer values; // the last alone
layout(set = 0, binding = 6, r32ui) uniform writeonly uimageBuffer brickBegins;
layout(set = 0, binding = 7) uniform utextureBuffer stopped;
layout(set = 0, binding = 8) uniform textureBuffer placedMotions; // kPlacedMotionTexels per sample
layout(set = 0, binding = 9) uniform textureBuffer motionTexels;
layout(set = 0, binding = 10, rgba32f) uniform writeonly imageBuffer motions;
layout(push_constant) uniform Push {
    BinPush push;
};

uint stoppedAt(int i) {
    return texelFetch(stopped, i).x;
}
#include "lib/moving_visibility.glsl"

void main() {
    const uint i =
        linearInvocation(gl_WorkGroupID, gl_NumWorkGroups, gl_WorkGroupSize, gl_LocalInvocationIndex);
    if (i > push.count) return;
    if (i == push.count) { // so that the prefix sum ends with the number of bricks
        imageStore(brickBegins, int(i), uvec4(0u));
        return;
    }
    const int index = int(texelFetch(indices, int(i)).x);
    const vec4 position = texelFetch(samplePositions, index);
    const float excess = kCompoundLens ? texelFetch(areaExcess, index).x : 0.0;
    const float ratio = position.w / sqrt(1.0 + excess);
    float weight;
    if (kMoving) {
        const vec4 motion = texelFetch(placedMotions, kPlacedMotionTexels * index);
        const MovingPoint point = MovingPoint(Trajectory(position.xy, position.z), motionOf(motion), 0.0);
        const float rank = texelFetch(placedMotions, kPlacedMotionTexels * index + 1).x;
        weight =
            movingVisibilityWeight(push.occlusion, READ_MOTION_LAYOUT, point, rank, push.grid.origin, ratio);
        imageStore(motions, int(i), motion);
    } else {
        const int block = blockOf(push.occlusion, position.xy, position.z, push.grid.origin);
        weight = visibilityWeight(push.occlusion, stoppedAt(block), ratio);
    }
    imageStore(positions, int(i), vec4(position.xyz, weight));
    imageStore(values, int(i), vec4(vec3(0.0), position.w));
    const uint cells = uint(push.grid.cellsPerBrick * push.grid.cellsPerBrick);
    const uint brick = texelFetch(keys, int(i)).x / cells;
    const bool begins = i == 0u || texelFetch(keys, int(i) - 1).x / cells != brick;
    imageStore(brickBegins, int(i), uvec4(begins ? 1u : 0u));
}

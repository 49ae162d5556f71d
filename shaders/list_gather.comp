#version 460
// The bricks of the sorted entries.
#extension GL_GOOGLE_include_directive : require
#include "resources/invocation.glsl"
#include "resources/moving.glsl"
#include "shared/reconstruct.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform utextureBuffer ids;
layout(set = 0, binding = 1) uniform utextureBuffer bricks;
layout(set = 0, binding = 2) uniform utextureBuffer cellBases;
layout(set = 0, binding = 3, rgba32ui) uniform writeonly uimageBuffer listBricks;
layout(set = 0, binding = 4, r32ui) uniform writeonly uimageBuffer listCellBases;
layout(set = 0, binding = 5) uniform textureBuffer brickMotions;
layout(set = 0, binding = 6, rgba32f) uniform writeonly imageBuffer listMotions;
layout(push_constant) uniform Push {
    OutputPush push;
};

void main() {
    const uint i =
        linearInvocation(gl_WorkGroupID, gl_NumWorkGroups, gl_WorkGroupSize, gl_LocalInvocationIndex);
    if (i >= push.count) return;
    const int id = int(texelFetch(ids, int(i)).x);
    imageStore(listBricks, int(i), texelFetch(bricks, id));
    imageStore(listCellBases, int(i), texelFetch(cellBases, id));
    if (!kMoving) return;
    for (int k = 0; k < kBrickMotionTexels; ++k)
        imageStore(listMotions, kBrickMotionTexels * int(i) + k,
                   texelFetch(brickMotions, kBrickMotionTexels * id + k));
}

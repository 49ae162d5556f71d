#version 460
// The occupied bricks: corner from the key, bounds of slope.
#extension GL_GOOGLE_include_directive : require
#include "lib/invocation.glsl"
#include "lib/ordered_float.glsl"
#include "shared/reconstruct.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform utextureBuffer brickKeys;
layout(set = 0, binding = 1) uniform utextureBuffer slopeMin;
layout(set = 0, binding = 2) uniform utextureBuffer slopeMax;
layout(set = 0, binding = 3, rgba32ui) uniform writeonly uimageBuffer bricks;
layout(push_constant) uniform Push { BinPush push; };

void main() {
    const uint i = linearInvocation(gl_WorkGroupID, gl_NumWorkGroups, gl_WorkGroupSize, gl_LocalInvocationIndex);
    if (i >= push.count) return;
    const int key = int(texelFetch(brickKeys, int(i)).x);
    const ivec2 count = push.grid.brickCount;
    const ivec2 corner = push.grid.cellsPerBrick * ivec2(key % count.x, key / count.x % count.y);
    imageStore(bricks, int(i),
               uvec4(uvec2(corner), floatBits(texelFetch(slopeMin, int(i)).x), floatBits(texelFetch(slopeMax, int(i)).x)));
}

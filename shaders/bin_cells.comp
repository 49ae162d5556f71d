#version 460
// The first record of each cell of each brick: where its key would stand among the sorted keys.
#extension GL_GOOGLE_include_directive : require
#include "lib/invocation.glsl"
#include "shared/reconstruct.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform utextureBuffer keys;
layout(set = 0, binding = 1) uniform utextureBuffer brickKeys;
layout(set = 0, binding = 2, r32ui) uniform writeonly uimageBuffer cellStart;
layout(push_constant) uniform Push { BinPush push; };

uint keyAt(uint i) { return texelFetch(keys, int(i)).x; }
#include "lib/lower_bound.glsl"

void main() {
    const uint i = linearInvocation(gl_WorkGroupID, gl_NumWorkGroups, gl_WorkGroupSize, gl_LocalInvocationIndex);
    if (i >= push.count) return;
    const uint cells = uint(push.grid.cellsPerBrick * push.grid.cellsPerBrick);
    const uint brick = i / cells;
    const uint key = brick < push.brickTotal ? texelFetch(brickKeys, int(brick)).x * cells + (i - brick * cells) : 0u;
    const uint start = brick < push.brickTotal ? lowerBound(key, push.grid.sampleCount) : push.grid.sampleCount;
    imageStore(cellStart, int(i), uvec4(start));
}

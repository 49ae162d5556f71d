#version 460
// The first record of each cell of each brick: where its key would stand among the sorted keys. One
// invocation per row of cells.
#extension GL_GOOGLE_include_directive : require
#include "resources/invocation.glsl"
#include "shared/reconstruct.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform utextureBuffer keys;
layout(set = 0, binding = 1) uniform utextureBuffer brickKeys;
layout(set = 0, binding = 2, r32ui) uniform writeonly uimageBuffer cellStart;
layout(push_constant) uniform Push {
    BinPush push;
};

uint keyAt(uint i) {
    return texelFetch(keys, int(i)).x;
}
#include "lib/lower_bound.glsl"

void main() {
    const uint row =
        linearInvocation(gl_WorkGroupID, gl_NumWorkGroups, gl_WorkGroupSize, gl_LocalInvocationIndex);
    const uint side = uint(push.grid.cellsPerBrick), records = push.grid.sampleCount, brick = row / side;
    if (row == 0u) imageStore(cellStart, int(push.brickTotal * side * side), uvec4(records));
    if (brick >= push.brickTotal) return;
    const uint key = texelFetch(brickKeys, int(brick)).x * side * side + (row - brick * side) * side;
    uint first = lowerBound(key, 0u, records);
    const uint end = lowerBound(key + side, first, records - first);
    for (uint column = 0u; column < side; ++column) {
        first = lowerBound(key + column, first, end - first);
        imageStore(cellStart, int(row * side + column), uvec4(first));
    }
}

#version 460
// Least and greatest slope of each brick, and the key at which it begins. Slopes are compared as unsigned integers
// in the order of the floats, so that atomics give the same in every order.
#extension GL_GOOGLE_include_directive : require
#include "lib/invocation.glsl"
#include "lib/ordered_float.glsl"
#include "shared/reconstruct.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform utextureBuffer keys;
layout(set = 0, binding = 1) uniform textureBuffer positions;
layout(set = 0, binding = 2) uniform utextureBuffer brickOfRecord; // prefix sum of brickBegins
layout(set = 0, binding = 3, r32ui) uniform uimageBuffer slopeMin;
layout(set = 0, binding = 4, r32ui) uniform uimageBuffer slopeMax;
layout(set = 0, binding = 5, r32ui) uniform writeonly uimageBuffer brickKeys;
layout(push_constant) uniform Push { BinPush push; };

void main() {
    const uint i = linearInvocation(gl_WorkGroupID, gl_NumWorkGroups, gl_WorkGroupSize, gl_LocalInvocationIndex);
    if (i >= push.count) return;
    const uint before = texelFetch(brickOfRecord, int(i)).x, after = texelFetch(brickOfRecord, int(i) + 1).x;
    const int brick = int(after) - 1;
    const uint slope = orderedBits(texelFetch(positions, int(i)).z);
    // Reading first spares most of the atomics; what is read can only be behind, never past.
    if (slope < imageLoad(slopeMin, brick).x) imageAtomicMin(slopeMin, brick, slope);
    if (slope > imageLoad(slopeMax, brick).x) imageAtomicMax(slopeMax, brick, slope);
    if (after > before) {
        const uint cells = uint(push.grid.cellsPerBrick * push.grid.cellsPerBrick);
        imageStore(brickKeys, brick, uvec4(texelFetch(keys, int(i)).x / cells));
    }
}

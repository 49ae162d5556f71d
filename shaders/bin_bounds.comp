#version 460
// Bounds of each brick's samples, and the key at which it begins. All are minima of unsigned integers
// (maxima through their complement, floats through their ordered bits), so that atomics give the same result
// in any order.
#extension GL_GOOGLE_include_directive : require
#include "lib/ordered_float.glsl"
#include "resources/invocation.glsl"
#include "shared/reconstruct.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform utextureBuffer keys;
layout(set = 0, binding = 1) uniform textureBuffer positions;
layout(set = 0, binding = 2) uniform utextureBuffer brickOfRecord; // prefix sum of brickBegins
layout(set = 0, binding = 3, r32ui) uniform uimageBuffer bounds;   // kBoundWords per brick
layout(set = 0, binding = 4, r32ui) uniform writeonly uimageBuffer brickKeys;
layout(set = 0, binding = 5) uniform textureBuffer values;
layout(push_constant) uniform Push {
    BinPush push;
};

void lower(int word, uint value) {
    // Reading first saves most of the atomics: the value read may be outdated, but never too low.
    if (value < imageLoad(bounds, word).x) imageAtomicMin(bounds, word, value);
}

void main() {
    const uint i =
        linearInvocation(gl_WorkGroupID, gl_NumWorkGroups, gl_WorkGroupSize, gl_LocalInvocationIndex);
    if (i >= push.count) return;
    const uint before = texelFetch(brickOfRecord, int(i)).x, after = texelFetch(brickOfRecord, int(i) + 1).x;
    const uint side = uint(push.grid.cellsPerBrick);
    const uint key = texelFetch(keys, int(i)).x, brickKey = key / (side * side),
               cell = key - brickKey * side * side;
    const uint row = cell / side, column = cell - row * side;
    const uint slope = orderedBits(texelFetch(positions, int(i)).z);
    const int word = (int(after) - 1) * int(kBoundWords);
    lower(word, slope);
    lower(word + 1, ~slope);
    lower(word + 2, column);
    lower(word + 3, row);
    lower(word + 4, ~column);
    lower(word + 5, ~row);
    lower(word + 6, floatBitsToUint(texelFetch(values, int(i)).w));
    if (after > before) imageStore(brickKeys, int(after) - 1, uvec4(brickKey));
}

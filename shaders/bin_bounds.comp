#version 460
// Bounds of each brick's samples, and the key at which it begins. All are minima of unsigned integers
// (maxima through their complement, floats through their ordered bits), so that atomics give the same result
// in any order.
#extension GL_GOOGLE_include_directive : require
#include "lib/grid.glsl"
#include "lib/ordered_float.glsl"
#include "resources/invocation.glsl"
#include "resources/moving.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform utextureBuffer keys;
layout(set = 0, binding = 1) uniform textureBuffer positions;
layout(set = 0, binding = 2) uniform utextureBuffer brickOfRecord; // prefix sum of brickBegins
layout(set = 0, binding = 3,
       r32ui) uniform uimageBuffer bounds; // kBoundWords per brick; and kMotionBoundWords
layout(set = 0, binding = 4, r32ui) uniform writeonly uimageBuffer brickKeys;
layout(set = 0, binding = 5) uniform textureBuffer values;
layout(set = 0, binding = 6) uniform utextureBuffer indices;      // of samples
layout(set = 0, binding = 7) uniform textureBuffer placedMotions; // kPlacedMotionTexels per sample
layout(push_constant) uniform Push {
    BinPush push;
};

void lower(int word, uint value) {
    // Reading first saves most of the atomics: the value read may be outdated, but never too low.
    if (value < imageLoad(bounds, word).x) imageAtomicMin(bounds, word, value);
}

/// Both the least and the greatest.
void widen(int word, float value) {
    lower(word, orderedBits(value));
    lower(word + 1, ~orderedBits(value));
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
    const vec4 position = texelFetch(positions, int(i));
    const int word = (int(after) - 1) * int(kMoving ? kBoundWords + kMotionBoundWords : kBoundWords);
    widen(word, position.z);
    lower(word + 2, column);
    lower(word + 3, row);
    lower(word + 4, ~column);
    lower(word + 5, ~row);
    lower(word + 6, floatBitsToUint(texelFetch(values, int(i)).w));
    if (kMoving) {
        const int sample_ = int(texelFetch(indices, int(i)).x) * kPlacedMotionTexels;
        const ivec2 bricks = push.grid.brickCount;
        const ivec2 place = ivec2(int(brickKey) % bricks.x, int(brickKey) / bricks.x % bricks.y);
        const MovingPoint point = MovingPoint(Trajectory(position.xy, position.z),
                                              motionOf(texelFetch(placedMotions, sample_)), 0.0);
        const vec2 drift = driftOf(point, brickCenter(push.grid, place));
        const int motionWord = word + int(kBoundWords);
        widen(motionWord, drift.x);
        widen(motionWord + 2, drift.y);
        widen(motionWord + 4, point.motion.depthRate);
        widen(motionWord + 6, texelFetch(placedMotions, sample_ + 1).x);
    }
    if (after > before) imageStore(brickKeys, int(after) - 1, uvec4(brickKey));
}

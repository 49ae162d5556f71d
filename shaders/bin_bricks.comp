#version 460
// The occupied bricks: place from the key, bounds as bin_bounds gathered them; and where in cellStart their
// cell at the grid's origin would stand (modulo 2^32), so that cells are found without dividing.
#extension GL_GOOGLE_include_directive : require
#include "lib/grid.glsl"
#include "lib/ordered_float.glsl"
#include "resources/invocation.glsl"
#include "resources/moving.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform utextureBuffer brickKeys;
layout(set = 0, binding = 1) uniform utextureBuffer bounds;
layout(set = 0, binding = 2, rgba32ui) uniform writeonly uimageBuffer bricks;
layout(set = 0, binding = 3, r32ui) uniform writeonly uimageBuffer cellBases;
layout(set = 0, binding = 4, rgba32f) uniform writeonly imageBuffer motions; // kBrickMotionTexels per brick
layout(set = 0, binding = 5, r32f) uniform writeonly imageBuffer ranks; // two per brick: Bins::brickRanks
layout(push_constant) uniform Push {
    BinPush push;
};

/// Least and greatest of what bin_bounds widened.
vec2 rangeAt(int word) {
    return uintBitsToFloat(
        uvec2(floatBits(texelFetch(bounds, word).x), floatBits(~texelFetch(bounds, word + 1).x)));
}

void main() {
    const uint i =
        linearInvocation(gl_WorkGroupID, gl_NumWorkGroups, gl_WorkGroupSize, gl_LocalInvocationIndex);
    if (i >= push.count) return;
    const int key = int(texelFetch(brickKeys, int(i)).x);
    const int word = int(i * (kMoving ? kBoundWords + kMotionBoundWords : kBoundWords));
    const ivec2 count = push.grid.brickCount;
    const ivec2 place = ivec2(key % count.x, key / count.x % count.y);
    const uvec2 corner = uvec2(place * push.grid.cellsPerBrick);
    const uint side = uint(push.grid.cellsPerBrick);
    imageStore(cellBases, int(i), uvec4(i * side * side - corner.y * side - corner.x));
    const uvec2 first = corner + uvec2(texelFetch(bounds, word + 2).x, texelFetch(bounds, word + 3).x);
    const uvec2 last = corner + uvec2(~texelFetch(bounds, word + 4).x, ~texelFetch(bounds, word + 5).x);
    const uvec2 extent = brickExtent(first, last, uintBitsToFloat(texelFetch(bounds, word + 6).x));
    imageStore(bricks, int(i), uvec4(extent, floatBitsToUint(rangeAt(word))));
    if (!kMoving) return;
    const int motionWord = word + int(kBoundWords);
    const vec2 x = rangeAt(motionWord), y = rangeAt(motionWord + 2), depthRate = rangeAt(motionWord + 4),
               rank = rangeAt(motionWord + 6);
    imageStore(motions, kBrickMotionTexels * int(i), vec4(x.x, y.x, x.y, y.y));
    imageStore(motions, kBrickMotionTexels * int(i) + 1, vec4(depthRate, brickCenter(push.grid, place)));
    imageStore(ranks, 2 * int(i), vec4(0.5 * (rank.x + rank.y)));
    imageStore(ranks, 2 * int(i) + 1, vec4(0.5 * (depthRate.x + depthRate.y)));
}

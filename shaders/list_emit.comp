#version 460
// (list, brick) for every tile that can see a brick through a lens group, in the order of groups and bricks:
// sorted stably by list, each list is ascending. One invocation per entry, so that large footprints are
// spread.
#extension GL_GOOGLE_include_directive : require
#include "lib/grid.glsl"
#include "resources/invocation.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform utextureBuffer bricks;
layout(set = 0, binding = 1) uniform textureBuffer lensBoxes;
layout(set = 0, binding = 2) uniform utextureBuffer offsets; // of (group, brick), and the total
layout(set = 0, binding = 3, r32ui) uniform writeonly uimageBuffer lists;
layout(set = 0, binding = 4, r32ui) uniform writeonly uimageBuffer listIds;
layout(set = 0, binding = 5) uniform textureBuffer lensTiles;
layout(set = 0, binding = 6) uniform textureBuffer brickMotions;
layout(set = 0, binding = 7) uniform utextureBuffer brickOrder; // of each slot of time
layout(set = 0, binding = 8) uniform textureBuffer groupTimes;  // first, last, slot
layout(set = 0, binding = 9) uniform textureBuffer motionTexels;
layout(push_constant) uniform Push {
    OutputPush push;
};

float lensTileBoundAt(int i) {
    return texelFetch(lensTiles, i).x;
}
#include "resources/tiles_of_brick.glsl"

uint keyAt(uint i) {
    return texelFetch(offsets, int(i)).x;
}
#include "lib/lower_bound.glsl"

void main() {
    const uint i =
        linearInvocation(gl_WorkGroupID, gl_NumWorkGroups, gl_WorkGroupSize, gl_LocalInvocationIndex);
    if (i >= push.count) return;
    const uint pair = lowerBound(i + 1u, 0u, push.groupCount * push.brickTotal + 1u) - 1u;
    const uint group = pair / push.brickTotal;
    const vec4 box = texelFetch(lensBoxes, int(push.firstGroup + group));
    const vec4 times = texelFetch(groupTimes, int(push.firstGroup + group));
    const int brick = brickAtRank(times, pair - group * push.brickTotal, push.brickTotal);
    const ivec4 range =
        tilesOfBrick(brick, push.grid, push.outputs, box, times.xy, int(group), push.marginPx);
    const int place = int(i - keyAt(pair)), width = range.z - range.x;
    const ivec2 tile = range.xy + ivec2(place % width, place / width);
    const ivec2 tiles = push.outputs.tileCount;
    imageStore(lists, int(i), uvec4((group * uint(tiles.y) + uint(tile.y)) * uint(tiles.x) + uint(tile.x)));
    imageStore(listIds, int(i), uvec4(uint(brick)));
}

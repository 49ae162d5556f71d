#version 460
// Which tiles can see a brick through a lens group, and how many: the prefix sum of that says where list_emit
// writes.
#extension GL_GOOGLE_include_directive : require
#include "lib/grid.glsl"
#include "resources/invocation.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform utextureBuffer bricks;
layout(set = 0, binding = 1) uniform textureBuffer lensBoxes;
layout(set = 0, binding = 2, r32ui) uniform writeonly uimageBuffer counts;
layout(set = 0, binding = 3) uniform textureBuffer lensTiles;
layout(set = 0, binding = 4) uniform textureBuffer brickMotions;
layout(set = 0, binding = 5) uniform utextureBuffer brickOrder; // of each slot of time
layout(set = 0, binding = 6) uniform textureBuffer groupTimes;  // first, last, slot
layout(set = 0, binding = 7) uniform textureBuffer motionTexels;
layout(set = 0, binding = 8, rgba32ui) uniform writeonly uimageBuffer ranges; // first, last tile; brick
layout(push_constant) uniform Push {
    OutputPush push;
};

float lensTileBoundAt(int i) {
    return texelFetch(lensTiles, i).x;
}
#include "resources/tiles_of_brick.glsl"

void main() {
    const uint i =
        linearInvocation(gl_WorkGroupID, gl_NumWorkGroups, gl_WorkGroupSize, gl_LocalInvocationIndex);
    if (i > push.count) return;
    uint tiles = 0u;
    if (i < push.count) {
        const uint group = i / push.brickTotal;
        const vec4 box = texelFetch(lensBoxes, int(push.firstGroup + group));
        const vec4 times = texelFetch(groupTimes, int(push.firstGroup + group));
        const int brick = brickAtRank(times, i % push.brickTotal, push.brickTotal);
        const ivec4 range =
            tilesOfBrick(brick, push.grid, push.outputs, box, times.xy, int(group), push.marginPx);
        const ivec2 size = max(range.zw - range.xy, ivec2(0));
        tiles = uint(size.x * size.y);
        const uvec4 packed = uvec4(max(range, ivec4(0)));
        imageStore(ranges, int(i),
                   uvec4(packed.x | packed.y << 16, packed.z | packed.w << 16, uint(brick), 0u));
    }
    imageStore(counts, int(i), uvec4(tiles));
}

#version 460
// (list, brick) for every tile that can see a brick through a lens group, in the order of groups and bricks:
// sorted stably by list, each list is front to back. One invocation per entry, so that large footprints are
// spread. Entries of tiles that do not see the brick after all (lib/lens_tiles.glsl) go behind all lists.
#extension GL_GOOGLE_include_directive : require
#include "resources/compound_lens.glsl"
#include "resources/invocation.glsl"
#include "resources/moving.glsl"
#include "shared/reconstruct.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform utextureBuffer ranges;  // of (group, brick): first, last tile; brick
layout(set = 0, binding = 1) uniform utextureBuffer offsets; // of (group, brick), and the total
layout(set = 0, binding = 2, r32ui) uniform writeonly uimageBuffer lists;
layout(set = 0, binding = 3, r32ui) uniform writeonly uimageBuffer listIds;
layout(set = 0, binding = 4) uniform utextureBuffer bricks;
layout(set = 0, binding = 5) uniform textureBuffer brickMotions;
layout(set = 0, binding = 6) uniform textureBuffer groupTimes; // first, last, slot
layout(set = 0, binding = 7) uniform textureBuffer motionTexels;
layout(set = 0, binding = 8) uniform textureBuffer listBoxes; // through a compound lens, kListBoxTexels each
layout(push_constant) uniform Push {
    OutputPush push;
};
#include "resources/swept_brick.glsl"

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
    const uvec4 range = texelFetch(ranges, int(pair));
    const uvec2 first = uvec2(range.x & 0xffffu, range.x >> 16);
    const uint place = i - keyAt(pair), width = (range.y & 0xffffu) - first.x;
    const uvec2 tile = first + uvec2(place % width, place / width), tiles = uvec2(push.outputs.tileCount);
    uint list = (group * tiles.y + tile.y) * tiles.x + tile.x;
    if (kCompoundLens) {
        const vec2 times = texelFetch(groupTimes, int(push.firstGroup + group)).xy;
        const int box = kListBoxTexels * int(list);
        if (!isSeen(sweptAt(int(range.z), push.grid, times), texelFetch(listBoxes, box),
                    texelFetch(listBoxes, box + 1)))
            list = push.groupCount * tiles.y * tiles.x;
    }
    imageStore(lists, int(i), uvec4(list));
    imageStore(listIds, int(i), uvec4(range.z));
}

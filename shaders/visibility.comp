#version 460
// Dense samples that reconstruct.comp left: apparent surfaces within twice the base radius, composited front
// to back. Outputs that find nothing are appended to a list for the next wider radius.
#extension GL_GOOGLE_include_directive : require
#include "resources/bins.glsl"
#include "resources/compound_lens.glsl"
#include "resources/invocation.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 9) uniform utextureBuffer pattern;
layout(set = 0, binding = 10) uniform utextureBuffer slots;
layout(set = 0, binding = 11, rgba32f) uniform writeonly imageBuffer dense;
layout(set = 0, binding = 12, r32ui) uniform uimageBuffer counters;
layout(set = 0, binding = 13, r32ui) uniform writeonly uimageBuffer holeList;
layout(set = 0, binding = 14, r32ui) uniform writeonly uimageBuffer overflowList;
layout(set = 0, binding = 15) uniform textureBuffer apertureTable;
layout(set = 0, binding = 16) uniform textureBuffer lensMap;

float apertureAt(int i) {
    return texelFetch(apertureTable, i).x;
}
vec4 lensMapAt(int texel) {
    return texelFetch(lensMap, texel);
}
#include "lib/aperture.glsl"
#include "lib/lens_map.glsl"
#include "lib/output_pattern.glsl"
#include "lib/visibility.glsl"

#include "lib/search.glsl"

void main() {
    readMotionLayout();
    const uint invocation =
        linearInvocation(gl_WorkGroupID, gl_NumWorkGroups, gl_WorkGroupSize, gl_LocalInvocationIndex);
    if (invocation >= push.count) return;
    const OutputLayout outputs = push.outputs;
    const uint slot = texelFetch(slots, int(invocation)).x;
    const uvec2 size = uvec2(outputs.regionSize);
    const uint k = slot / (size.x * size.y), pixel = slot - k * (size.x * size.y);
    const ivec2 position = ivec2(pixel % size.x, pixel / size.x);
    const ivec2 tile = position / kTileSize;
    const int index = push.firstOutput + int(k);
    Output o = outputAt(outputs.regionOrigin + position, index, texelFetch(pattern, index), push.lensCells,
                        push.lensScale, outputs.seed);
    if (kMoving)
        o.t = timeInShutter(outputs.regionOrigin + position, index, texelFetch(pattern, index).z,
                            outputs.outputsPerPixel, outputs.seed,
                            vec2(motionLayout.shutterOpen, motionLayout.shutterSpan));
    if (kCompoundLens) toSceneSide(o, sceneRay(o.xy, o.uv));
    const int list =
        ((int(k) >> push.groupBits) * outputs.tileCount.y + tile.y) * outputs.tileCount.x + tile.x;
    Sweep sweep = newSweep(push.grid, push.baseRadiusPx);
    const uint begin = texelFetch(listStart, list).x, end = texelFetch(listStart, list + 1).x;
    const int steps =
        forEachCandidate(push.grid, o, 2.0 * push.baseRadiusPx, kAnyRadiusRatio, begin, end, sweep);
    if (steps > kMaxSteps) {
        imageStore(overflowList, int(imageAtomicAdd(counters, int(kOverflowCount), 1u)), uvec4(slot));
    } else if (foundNothing(sweep)) {
        imageStore(holeList, int(imageAtomicAdd(counters, int(kHoleCount), 1u)), uvec4(slot));
        imageStore(dense, int(slot), vec4(0.0, 0.0, 0.0, -1.0));
    } else {
        imageStore(dense, int(slot), vec4(o.weight * radianceOf(sweep), o.positionCode));
    }
}

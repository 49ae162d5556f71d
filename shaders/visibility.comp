#version 460
// Dense samples that reconstruct.comp left: apparent surfaces within twice the base radius, laid over one another
// front to back. What finds nothing is appended to a list for the next wider radius.
#extension GL_GOOGLE_include_directive : require
#include "lib/bins.glsl"
#include "lib/grid.glsl"
#include "lib/invocation.glsl"
#include "lib/surface.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 6) uniform utextureBuffer pattern;
layout(set = 0, binding = 7) uniform utextureBuffer slots;
layout(set = 0, binding = 8, rgba32f) uniform writeonly imageBuffer dense;
layout(set = 0, binding = 9, r32ui) uniform uimageBuffer counters;
layout(set = 0, binding = 10, r32ui) uniform writeonly uimageBuffer holeList;
layout(set = 0, binding = 11, r32ui) uniform writeonly uimageBuffer overflowList;
layout(set = 0, binding = 12) uniform textureBuffer apertureTable;

float apertureAt(int i) { return texelFetch(apertureTable, i).x; }
layout(set = 0, binding = 13) uniform textureBuffer lensMap;

vec4 lensMapAt(int texel) { return texelFetch(lensMap, texel); }
#include "lib/output_pattern.glsl"
#include "lib/scene_side.glsl"

struct Sweep {
    bool running;
    float baseRadius, surfaceGap, fullWeight;
    Surface surface;
    Layers layers;
};

void visit(Candidate candidate, inout Sweep sweep) {
    if (sweep.surface.count > 0 && candidate.slope > sweep.surface.slopeMax + sweep.surfaceGap) {
        addSurface(sweep.layers, sweep.surface, sweep.fullWeight);
        sweep.surface = noSurface();
        sweep.running = sweep.layers.transmittance > 0.0;
        if (!sweep.running) return;
    }
    addSample(sweep.surface, candidate, sweep.baseRadius);
}

bool hides(Sweep sweep, Brick brick) {
    return brick.slopeMin > sweep.surface.slopeMax + sweep.surfaceGap && isSolid(sweep.surface, sweep.fullWeight);
}
#include "lib/search.glsl"

void main() {
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
    if (kCompoundLens) toSceneSide(o);
    const int list =
        ((int(k) >> push.groupBits) * outputs.tileCount.y + tile.y) * outputs.tileCount.x + tile.x;
    const float widening = push.baseRadiusPx / push.grid.radiusPx;
    Sweep sweep = Sweep(true, push.baseRadiusPx, push.grid.surfaceGap, kFullWeight * widening * widening, noSurface(),
                        Layers(vec3(0.0), 1.0));
    const bool complete = forEachCandidate(push.grid, o, 2.0 * push.baseRadiusPx, kAnyRadiusRatio, texelFetch(listStart, list).x,
                                           texelFetch(listStart, list + 1).x, sweep);
    if (!complete) {
        imageStore(overflowList, int(imageAtomicAdd(counters, int(kOverflowCount), 1u)), uvec4(slot));
    } else if (sweep.surface.count == 0 && sweep.running) {
        imageStore(holeList, int(imageAtomicAdd(counters, int(kHoleCount), 1u)), uvec4(slot));
        imageStore(dense, int(slot), vec4(0.0, 0.0, 0.0, -1.0));
    } else {
        Layers layers = sweep.layers;
        if (sweep.surface.count > 0) layers.rgb += layers.transmittance * meanOf(sweep.surface);
        imageStore(dense, int(slot), vec4(o.weight * layers.rgb, o.positionCode));
    }
}

#version 460
// Level 0 of the layer map: the surfaces around the pinhole position of each texel. As resolveTexel of
// host/reconstruct/layer_map.cpp.
#extension GL_GOOGLE_include_directive : require
#include "lib/bins.glsl"
#include "lib/grid.glsl"
#include "lib/surface.glsl"
#include "shared/layers.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 6, rgba32f) uniform writeonly imageBuffer heads;
layout(set = 0, binding = 7, rgba32f) uniform writeonly imageBuffer layers;
layout(set = 0, binding = 8, r32ui) uniform uimageBuffer counters;
layout(set = 0, binding = 9, r32ui) uniform writeonly uimageBuffer overflowList;

struct Sweep {
    bool running;
    float radius, surfaceGap, fullWeight;
    Surface surface;
    int texel;
    vec4 head;
};

void close(inout Sweep sweep, bool last) {
    const Surface surface = sweep.surface;
    if (!(surface.innerWeight > 0.0)) return;
    const int count = int(sweep.head.w);
    const bool full = (last && count == 0) || isSolid(surface, sweep.fullWeight);
    const float coverage = full ? 1.0 : min(surface.innerWeight / sweep.fullWeight, 1.0);
    const float slope = surface.slopeSum / surface.innerWeight;
    if (count == 0) sweep.head.x = slope;
    if (count == 1) sweep.head.y = slope;
    if (count == 2) sweep.head.z = slope;
    imageStore(layers, sweep.texel * kMapLayers + count, vec4(surface.innerSum / surface.innerWeight, coverage));
    sweep.head.w = float(count + 1);
}

void visit(Candidate candidate, inout Sweep sweep) {
    if (sweep.surface.count > 0 && candidate.slope > sweep.surface.slopeMax + sweep.surfaceGap) {
        close(sweep, false);
        sweep.surface = noSurface();
        sweep.running = int(sweep.head.w) < kMapLayers;
        if (!sweep.running) return;
    }
    addSample(sweep.surface, candidate, radianceAt(candidate.record), sweep.radius);
}

bool hides(Sweep sweep, Brick brick) { return false; }
#include "lib/search.glsl"

void main() {
    const ivec2 place = ivec2(gl_GlobalInvocationID.xy), size = push.outputs.regionSize * kMapTexels;
    if (place.x >= size.x || place.y >= size.y) return;
    const ivec2 tile = place / (kTileSize * kMapTexels);
    const int list = tile.y * push.outputs.tileCount.x + tile.x;
    const float widening = push.radiusPx / push.grid.radiusPx;
    const float fullWeight = kFullWeight * widening * widening;
    const int texel = place.y * size.x + place.x;
    const vec2 p = vec2(push.outputs.regionOrigin) + (vec2(place) + 0.5) * (1.0 / float(kMapTexels));
    const uint begin = texelFetch(listStart, list).x, end = texelFetch(listStart, list + 1).x;
    vec4 head = vec4(0.0, 0.0, 0.0, 2.0);
    bool complete = true;
    for (int reach = 1; reach <= 2 && head.w > 1.0; ++reach) {
        Sweep sweep = Sweep(true, push.radiusPx, push.grid.surfaceGap, fullWeight, noSurface(), texel,
                            vec4(kNoLayer, kNoLayer, kNoLayer, 0.0));
        complete = forEachCandidate(push.grid, Output(p, vec2(0.0), 0.0, 0.0), float(reach) * push.radiusPx, begin, end,
                                    sweep) && complete;
        if (sweep.surface.count > 0) close(sweep, true);
        head = sweep.head;
    }
    if (!complete) imageStore(overflowList, int(imageAtomicAdd(counters, int(kOverflowCount), 1u)), uvec4(texel));
    for (int i = int(head.w); i < kMapLayers; ++i) imageStore(layers, texel * kMapLayers + i, vec4(0.0));
    imageStore(heads, texel, head);
}

#version 460
// Level 0 of the layer map: the surfaces around the pinhole position of each texel. As resolveTexel of
// host/reconstruct/layer_map.cpp.
#extension GL_GOOGLE_include_directive : require
#include "lib/bins.glsl"
#include "lib/grid.glsl"
#include "lib/map_texel.glsl"
#include "lib/surface.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 6, rgba32ui) uniform writeonly uimageBuffer texels;
layout(set = 0, binding = 7, r32ui) uniform uimageBuffer counters;
layout(set = 0, binding = 8, r32ui) uniform writeonly uimageBuffer overflowList;

struct Sweep {
    bool running;
    float radius, maxRadiusRatio, surfaceGap, fullWeight;
    SlopeCode code;
    Surface surface;
    int count;
    uvec4 texel;
};

void close(inout Sweep sweep, bool last) {
    const Surface surface = sweep.surface;
    if (!(surface.innerWeight > 0.0)) return;
    const bool full = (last && sweep.count == 0) || isSolid(surface, sweep.fullWeight);
    const float coverage = full ? 1.0 : min(surface.innerWeight / sweep.fullWeight, 1.0);
    const float slope = surface.slopeSum / surface.innerWeight;
    const uvec2 words = packLayer(surface.innerSum / surface.innerWeight, coverage, slope, sweep.code);
    sweep.texel = sweep.count == 0 ? uvec4(words, kNoLayerWords) : uvec4(sweep.texel.xy, words);
    ++sweep.count;
}

void visit(Candidate candidate, inout Sweep sweep) {
    if (sweep.surface.count > 0 && candidate.slope > sweep.surface.slopeMax + sweep.surfaceGap) {
        close(sweep, false);
        sweep.surface = noSurface();
        sweep.running = sweep.count < kMapLayers;
        if (!sweep.running) return;
    }
    // Where own radii are less than the tent's, there are more samples in it than it takes.
    const float widened = min(candidate.value.w, sweep.maxRadiusRatio) / candidate.value.w;
    candidate.weight *= widened * widened;
    addSample(sweep.surface, candidate, sweep.radius);
}

bool hides(Sweep sweep, Brick brick) { return false; }
#include "lib/search.glsl"

void main() {
    const int side = 1 << (findMSB(uint(push.outputs.outputsPerPixel)) >> 1); // texels along that of a pixel
    const ivec2 place = ivec2(gl_GlobalInvocationID.xy), size = push.outputs.regionSize * side;
    if (place.x >= size.x || place.y >= size.y) return;
    const ivec2 tile = place / (kTileSize * side);
    const int list = tile.y * push.outputs.tileCount.x + tile.x;
    const float widening = push.baseRadiusPx / push.grid.radiusPx;
    const float fullWeight = kFullWeight * widening * widening;
    const float maxRadiusRatio = push.baseRadiusPx * float(side);
    const vec2 p = vec2(push.outputs.regionOrigin) + (vec2(place) + 0.5) * (1.0 / float(side));
    const uint begin = texelFetch(listStart, list).x, end = texelFetch(listStart, list + 1).x;
    Sweep sweep;
    sweep.count = 2;
    bool complete = true;
    for (int reach = 1; reach <= 2 && sweep.count > 1; ++reach) {
        sweep = Sweep(true, push.baseRadiusPx, maxRadiusRatio, push.grid.surfaceGap, fullWeight, slopeCode(push.grid),
                      noSurface(), 0, uvec4(kNoLayerWords, kNoLayerWords));
        complete = forEachCandidate(push.grid, outputOnFilm(p, vec2(0.0), 0.0, 0.0), float(reach) * push.baseRadiusPx,
                                    maxRadiusRatio, begin, end, sweep) && complete;
        if (sweep.surface.count > 0) close(sweep, true);
    }
    const int texel = place.y * size.x + place.x;
    if (!complete) imageStore(overflowList, int(imageAtomicAdd(counters, int(kOverflowCount), 1u)), uvec4(texel));
    imageStore(texels, texel, sweep.texel);
}

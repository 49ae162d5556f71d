#version 460
// Level 0 of the layer map: the surfaces around the pinhole position of each texel.
#extension GL_GOOGLE_include_directive : require
#include "lib/map_texel.glsl"
#include "resources/bins.glsl"
#include "resources/compound_lens.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 9, rgba32ui) uniform writeonly uimageBuffer texels;
layout(set = 0, binding = 10, r32ui) uniform uimageBuffer counters;
layout(set = 0, binding = 11, r32ui) uniform writeonly uimageBuffer overflowList;

layout(set = 0, binding = 12, rgba32ui) uniform writeonly uimageBuffer mapMotions; // of both layers
layout(set = 0, binding = 13) uniform textureBuffer lensMap;                       // of distortion alone

vec4 lensMapAt(int texel) {
    return texelFetch(lensMap, texel);
}
#include "lib/lens_map.glsl"

struct LayerTexel {
    uvec4 words, motions;
    int count;
};

LayerTexel noLayers() {
    return LayerTexel(uvec4(kNoLayerWords, kNoLayerWords), uvec4(0u), 0);
}

void keepLayer(vec3 rgb, float coverage, float slope, vec3 motion, SlopeCode code, inout LayerTexel texel) {
    const uvec2 words = packLayer(rgb, coverage, slope, code);
    texel.words = texel.count == 0 ? uvec4(words, kNoLayerWords) : uvec4(texel.words.xy, words);
    if (kMoving) {
        const uvec2 moving = packMotion(motion, motionLayout);
        texel.motions = texel.count == 0 ? uvec4(moving, 0u, 0u) : uvec4(texel.motions.xy, moving);
    }
    ++texel.count;
}
#include "lib/map_sweep.glsl"
#include "lib/search.glsl"

void main() {
    readMotionLayout();
    const int side = 1 << (findMSB(uint(push.outputs.outputsPerPixel)) >> 1); // texels along that of a pixel
    const ivec2 place = ivec2(gl_GlobalInvocationID.xy), size = push.outputs.regionSize * side;
    if (place.x >= size.x || place.y >= size.y) return;
    const ivec2 tile = place / (kTileSize * side);
    const int list = tile.y * push.outputs.tileCount.x + tile.x;
    Output o = outputOnFilm(vec2(push.outputs.regionOrigin) + (vec2(place) + 0.5) * (1.0 / float(side)),
                            vec2(0.0), 0.5, 0.0);
    if (kCompoundLens) toSceneSide(o, sceneRay(o.xy, o.uv));
    const uint begin = texelFetch(listStart, list).x, end = texelFetch(listStart, list + 1).x;
    Sweep sweep;
    sweep.texel.count = 2;
    bool complete = true;
    if (!(o.weight > 0.0)) sweep.texel = noLayers(); // beyond the lens map
    for (int reach = 1; reach <= 2 && sweep.texel.count > 1; ++reach) {
        sweep = newSweep(push.grid, push.baseRadiusPx, float(side), slopeCode(push.grid));
        const int steps = forEachCandidate(push.grid, o, float(reach) * push.baseRadiusPx,
                                           sweep.maxRadiusRatio, begin, end, sweep);
        complete = complete && steps <= kMaxSteps;
        if (sweep.surface.count > 0) close(sweep, true);
    }
    const int texel = place.y * size.x + place.x;
    if (!complete)
        imageStore(overflowList, int(imageAtomicAdd(counters, int(kOverflowCount), 1u)), uvec4(texel));
    imageStore(texels, texel, sweep.texel.words);
    if (kMoving) imageStore(mapMotions, texel, sweep.texel.motions);
}

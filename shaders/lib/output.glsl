// An output: its place in pixel, lens and time; the first of these. As in host/reconstruct/output_pattern.h.
#ifndef SLANT_LIB_OUTPUT_GLSL
#define SLANT_LIB_OUTPUT_GLSL
#include "lib/hash.glsl"
#include "shared/reconstruct.h"

struct Output {
    vec2 xy;
    vec2 uv;
    float t;
    float positionCode;

    // Set by toSceneSide.
    float weight; // of the radiance
    vec3 filmMetric;
    vec2 extent;
};

/// Outputs look through a lens of many surfaces: the samples are on its scene's side (host/camera/lens_map.h).
layout(constant_id = 0) const bool kCompoundLens = false;

Output outputOnFilm(vec2 xy, vec2 uv, float t, float positionCode) {
    return Output(xy, uv, t, positionCode, 1.0, vec3(1.0, 0.0, 1.0), vec2(1.0));
}

/// From a distance on the scene's side to one on the film.
vec2 onFilm(Output o, vec2 offset) {
    const vec3 m = o.filmMetric;
    return vec2(m.x * offset.x + m.y * offset.y, m.y * offset.x + m.z * offset.y);
}

/// Lens cell of an entry of the output pattern: column, row.
uvec2 lensCell(uvec4 entry) { return uvec2(entry.w & 255u, entry.w >> 16); }

/// Which output of a group comes in the place of this one in the group's order, for its first 2^n.
uint inOrder(uvec4 entry) { return bitfieldExtract(entry.w, 8, 8); }

/// Nested uniform scramble of bit-reversed x (Laine and Karras 2011; constants of Burley 2020, listing 1).
uint owenScramble(uint reversed, uint seed) {
    uint x = reversed;
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return bitfieldReverse(x);
}

uint seedOf(ivec2 pixel, uint seed) { return hash(uint(pixel.x) + hash(uint(pixel.y) + hash(seed))); }

/// An output of a pixel, seen through the middle of the lens.
Output placed(ivec2 pixel, uvec4 entry, uint pixelSeed) {
    const uint qx = owenScramble(entry.x, hash(pixelSeed ^ 0xa511e9b3u)) >> 20;
    const uint qy = owenScramble(entry.y, hash(pixelSeed ^ 0x63d83595u)) >> 20;
    return outputOnFilm(vec2(pixel) + (vec2(float(qx), float(qy)) + 0.5) * (1.0 / float(kSubpixels)), vec2(0.0), 0.0,
                        float(qx * uint(kSubpixels) + qy));
}
#endif

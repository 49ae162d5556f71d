// Where the outputs of a pixel lie in pixel, lens and time. As host/reconstruct/output_pattern.cpp.
//
// Needs what lib/aperture.glsl needs.
#ifndef SLANT_LIB_OUTPUT_PATTERN_GLSL
#define SLANT_LIB_OUTPUT_PATTERN_GLSL
#include "lib/aperture.glsl"
#include "lib/hash.glsl"
#include "lib/output.glsl"
#include "shared/reconstruct.h"

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

Output outputAt(ivec2 pixel, int index, uvec4 entry, ivec2 lensCells, float lensScale, uint seed) {
    const uint pixelSeed = hash(uint(pixel.x) + hash(uint(pixel.y) + hash(seed)));
    const uint qx = owenScramble(entry.x, hash(pixelSeed ^ 0xa511e9b3u)) >> 20;
    const uint qy = owenScramble(entry.y, hash(pixelSeed ^ 0x63d83595u)) >> 20;
    const uint qt = owenScramble(entry.z, hash(pixelSeed ^ 0x9e3779b9u)) >> 8;
    const uint jitter = hash(pixelSeed + uint(index) * 0x9e3779b9u);
    const vec2 cell = vec2(float(entry.w & 0xffffu), float(entry.w >> 16)) +
                      (vec2(float(jitter & 0xffffu), float(jitter >> 16)) + 0.5) * (1.0 / 65536.0);
    Output o;
    o.xy = vec2(pixel) + (vec2(float(qx), float(qy)) + 0.5) * (1.0 / float(kSubpixels));
    o.uv = lensScale * lensPosition(cell * (2.0 / vec2(lensCells)) - 1.0);
    o.t = float(qt) * (1.0 / 16777216.0);
    o.positionCode = float(qx * uint(kSubpixels) + qy);
    return o;
}
#endif

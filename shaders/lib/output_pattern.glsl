// Where the outputs of a pixel lie in pixel, lens and time. As host/reconstruct/output_pattern.cpp.
//
// Needs what lib/aperture.glsl needs.
#ifndef SLANT_LIB_OUTPUT_PATTERN_GLSL
#define SLANT_LIB_OUTPUT_PATTERN_GLSL
#include "lib/aperture.glsl"
#include "lib/output.glsl"

Output outputAt(ivec2 pixel, int index, uvec4 entry, ivec2 lensCells, float lensScale, uint seed) {
    const uint pixelSeed = seedOf(pixel, seed);
    const uint qt = owenScramble(entry.z, hash(pixelSeed ^ 0x9e3779b9u)) >> 8;
    const uint jitter = hash(pixelSeed + uint(index) * 0x9e3779b9u);
    const vec2 cell = vec2(lensCell(entry)) +
                      (vec2(float(jitter & 0xffffu), float(jitter >> 16)) + 0.5) * (1.0 / 65536.0);
    Output o = placed(pixel, entry, pixelSeed);
    o.uv = lensScale * lensPosition(cell * (2.0 / vec2(lensCells)) - 1.0);
    o.t = float(qt) * (1.0 / 16777216.0);
    return o;
}
#endif

// Where the outputs of a pixel lie in pixel, lens and time, which host/reconstruct/output_pattern.h explains.
//
// Needs, declared before the include: lensPosition(vec2), as in lib/aperture.glsl. In C++ it is included in a
// struct that has that, after lib/output.glsl.
#include "lib/output.glsl"

KERNEL Output outputAt(ivec2 pixel, int index, uvec4 entry, ivec2 lensCells, float lensScale, uint seed) {
    const uint pixelSeed = seedOf(pixel, seed);
    const uint qt = owenScramble(entry.z, hash(pixelSeed ^ 0x9e3779b9u)) >> 8;
    const uint jitter = hash(pixelSeed + uint(index) * 0x9e3779b9u);
    const vec2 cell = vec2(lensCell(entry)) +
                      (vec2(float(jitter & 0xffffu), float(jitter >> 16)) + 0.5f) * (1.0f / 65536.0f);
    Output o = placed(pixel, entry, pixelSeed);
    o.uv = lensScale * lensPosition(cell * (2.0f / vec2(lensCells)) - 1.0f);
    o.t = float(qt) * (1.0f / 16777216.0f);
    return o;
}

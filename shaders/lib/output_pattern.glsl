// Where the outputs of a pixel lie in pixel, lens and time. As host/reconstruct/output_pattern.cpp.
#ifndef SLANT_LIB_OUTPUT_PATTERN_GLSL
#define SLANT_LIB_OUTPUT_PATTERN_GLSL
#include "lib/hash.glsl"
#include "shared/reconstruct.h"

struct Output {
    vec2 xy;
    vec2 uv;
    float t;
    float positionCode;
};

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

/// Shirley and Chiu's concentric map from [-1, 1]^2 to the unit disc.
vec2 concentricDisc(vec2 square) {
    const float a = square.x, b = square.y;
    if (a == 0.0 && b == 0.0) return vec2(0.0);
    const bool wide = abs(a) > abs(b);
    const float r = wide ? a : b;
    const float q = wide ? b / a : a / b;
    const float x = q * 0.785398163;
    const float z = x * x;
    const float sine =
        x * (1.0 + z * (-0.166666667 + z * (0.00833333333 + z * (-0.000198412698 + z * 2.75573192e-6))));
    const float cosine =
        1.0 + z * (-0.5 + z * (0.0416666667 + z * (-0.00138888889 + z * 2.48015873e-5)));
    return wide ? vec2(r * cosine, r * sine) : vec2(r * sine, r * cosine);
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
    o.uv = lensScale * concentricDisc(cell * (2.0 / vec2(lensCells)) - 1.0);
    o.t = float(qt) * (1.0 / 16777216.0);
    o.positionCode = float(qx * uint(kSubpixels) + qy);
    return o;
}
#endif

// A texel of the layer map and its words. As host/reconstruct/map_texel.h, where they are explained.
#ifndef SLANT_LIB_MAP_TEXEL_GLSL
#define SLANT_LIB_MAP_TEXEL_GLSL
#include "shared/layer_map.h"

const uint kMinExponent = 11u, kFloatBias = 127u, kExponentBias = 137u;
const uvec2 kNoLayerWords = uvec2(0u, kNoSlopeCode << 16);

float powerOfTwo(uint biased) { return uintBitsToFloat(biased << 23); }

SlopeCode slopeCode(GridLayout grid) {
    const float perStep = float(kNoSlopeCode - 1u) * grid.invBucket / float(grid.bucketCount);
    return SlopeCode(grid.slopeMin, 1.0 / perStep, perStep);
}

uvec2 packLayer(vec3 rgb, float coverage, float slope, SlopeCode code) {
    const float most = max(max(rgb.x, rgb.y), rgb.z);
    const uint exponent = max(floatBitsToUint(most) >> 23, kMinExponent);
    const float scale = powerOfTwo(kFloatBias + kExponentBias - exponent);
    const uint r = min(uint(rgb.x * scale + 0.5), 2047u);
    const uint g = min(uint(rgb.y * scale + 0.5), 2047u);
    const uint b = min(uint(rgb.z * (0.5 * scale) + 0.5), 1023u);
    const float steps = (slope - code.least) * code.perStep;
    const uint slopeCode = uint(clamp(steps + 0.5, 0.0, float(kNoSlopeCode - 1u)));
    return uvec2(r | g << 11 | b << 22, exponent | max(uint(coverage * 255.0 + 0.5), 1u) << 8 | slopeCode << 16);
}

float unpackSlope(uint word, SlopeCode code) {
    const uint steps = word >> 16;
    return steps == kNoSlopeCode ? kNoLayer : code.least + float(int(steps)) * code.step;
}

/// Radiance, coverage.
vec4 unpackLayer(uvec2 words) {
    const float scale = powerOfTwo((words.y & 0xffu) - (kExponentBias - kFloatBias));
    return vec4(float(int(words.x & 2047u)) * scale, float(int(words.x >> 11 & 2047u)) * scale,
                float(int(words.x >> 22)) * (2.0 * scale), float(int(words.y >> 8 & 0xffu)) * (1.0 / 255.0));
}
#endif

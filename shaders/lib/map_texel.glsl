// The two words of a layer of a map's texel: 11, 11 and 10 bits of red, green and blue; their common
// exponent, coverage in 1/255 (at least 1), and slope as a code. Colours are off by at most 1/2048 of the
// largest (blue: 1/1024), slopes by half a step.
#ifndef SLANT_LIB_MAP_TEXEL_GLSL
#define SLANT_LIB_MAP_TEXEL_GLSL
#include "shared/kernel.h"
#include "shared/layer_map.h"
#include "shared/motion.h"

SLANT_SHARED_BEGIN

/// What a common exponent e (biased as a float's) stands for: 2^(e - 137), so that values below 2^(e - 126)
/// take 11 bits.
SLANT_SHARED_CONSTANT uint kMinExponent = 11u;
SLANT_SHARED_CONSTANT uint kFloatBias = 127u;
SLANT_SHARED_CONSTANT uint kExponentBias = 137u;
SLANT_SHARED_CONSTANT uvec2 kNoLayerWords = uvec2(0u, kNoSlopeCode << 16);

KERNEL float powerOfTwo(uint biased) {
    return uintBitsToFloat(biased << 23);
}

/// Codes of the slopes that a grid distinguishes.
KERNEL SlopeCode slopeCode(IN(GridLayout) grid) {
    const float perStep = float(kNoSlopeCode - 1u) * grid.invBucket / float(grid.bucketCount);
    const SlopeCode code = {grid.slopeMin, 1.0f / perStep, perStep};
    return code;
}

/// A layer that exists.
KERNEL uvec2 packLayer(vec3 rgb, float coverage, float slope, IN(SlopeCode) code) {
    const float most = max(max(rgb.x, rgb.y), rgb.z);
    const uint exponent = max(floatBitsToUint(most) >> 23, kMinExponent);
    const float scale = powerOfTwo(kFloatBias + kExponentBias - exponent);
    const uint r = min(uint(rgb.x * scale + 0.5f), 2047u);
    const uint g = min(uint(rgb.y * scale + 0.5f), 2047u);
    const uint b = min(uint(rgb.z * (0.5f * scale) + 0.5f), 1023u);
    const float steps = (slope - code.least) * code.perStep;
    const uint slopeSteps = uint(clamp(steps + 0.5f, 0.0f, float(kNoSlopeCode - 1u)));
    return uvec2(r | g << 11 | b << 22,
                 exponent | max(uint(coverage * 255.0f + 0.5f), 1u) << 8 | slopeSteps << 16);
}

/// Of the second word of a layer; kNoLayer without one.
KERNEL float unpackSlope(uint word, IN(SlopeCode) code) {
    const uint steps = word >> 16;
    return steps == kNoSlopeCode ? kNoLayer : code.least + float(int(steps)) * code.step;
}

/// Radiance, coverage.
KERNEL vec4 unpackLayer(uvec2 words) {
    const float scale = powerOfTwo((words.y & 0xffu) - (kExponentBias - kFloatBias));
    return vec4(float(int(words.x & 2047u)) * scale, float(int(words.x >> 11 & 2047u)) * scale,
                float(int(words.x >> 22)) * (2.0f * scale),
                float(int(words.y >> 8 & 0xffu)) * (1.0f / 255.0f));
}

/// How a layer moves: two words, of velocity in 1 / kVelocitySteps of all that the field has, and depth rate.
KERNEL uvec2 packMotion(vec3 motion, IN(MotionLayout) layout_) {
    const vec2 perStep = kVelocitySteps * layout_.invVelocity / layout_.velocityCount;
    const vec2 steps = (vec2(motion) - layout_.velocityMin) * perStep + 0.5f;
    const uvec2 code = uvec2(clamp(steps, vec2(0.0f), vec2(kVelocitySteps)));
    return uvec2(code.x | code.y << 16, floatBitsToUint(motion.z));
}
KERNEL vec3 unpackMotion(uvec2 words, IN(MotionLayout) layout_) {
    const vec2 step_ = layout_.velocityCount * (1.0f / (kVelocitySteps * layout_.invVelocity));
    const vec2 code = vec2(float(int(words.x & 0xffffu)), float(int(words.x >> 16)));
    return vec3(layout_.velocityMin + code * step_, uintBitsToFloat(words.y));
}

SLANT_SHARED_END
#endif

#include "reconstruct/map_texel.h"

#include <bit>

namespace slant {
namespace {

/// What a common exponent e (biased as a float's) stands for: 2^(e - 137), so that values below 2^(e - 126)
/// take 11 bits.
constexpr uint kMinExponent = 11, kFloatBias = 127, kExponentBias = 137;

float powerOfTwo(uint biased) {
    return std::bit_cast<float>(biased << 23);
}

glm::uvec2 packLayer(const MapLayer& layer, const SlopeCode& code) {
    if (layer.slope == kNoLayer) return {0, kNoSlopeCode << 16};
    const float most = glm::max(glm::max(layer.rgb.x, layer.rgb.y), layer.rgb.z);
    const uint exponent = glm::max(std::bit_cast<uint>(most) >> 23, kMinExponent);
    const float scale = powerOfTwo(kFloatBias + kExponentBias - exponent);
    const uint r = glm::min(uint(layer.rgb.x * scale + 0.5f), 2047u);
    const uint g = glm::min(uint(layer.rgb.y * scale + 0.5f), 2047u);
    const uint b = glm::min(uint(layer.rgb.z * (0.5f * scale) + 0.5f), 1023u);
    const float steps = (layer.slope - code.least) * code.perStep;
    const uint slope = uint(glm::clamp(steps + 0.5f, 0.f, float(kNoSlopeCode - 1)));
    const uint coverage = glm::max(uint(layer.coverage * 255.f + 0.5f), 1u);
    return {r | g << 11 | b << 22, exponent | coverage << 8 | slope << 16};
}

} // namespace

SlopeCode slopeCode(const GridLayout& grid) {
    const float perStep = float(kNoSlopeCode - 1) * grid.invBucket / float(grid.bucketCount);
    return {grid.slopeMin, 1 / perStep, perStep};
}

float unpackSlope(uint word, const SlopeCode& code) {
    const uint steps = word >> 16;
    return steps == kNoSlopeCode ? kNoLayer : code.least + float(steps) * code.step;
}

MapLayer unpackLayer(glm::uvec2 words, const SlopeCode& code) {
    const float scale = powerOfTwo((words.y & 0xffu) - (kExponentBias - kFloatBias));
    return {vec3(float(words.x & 2047u) * scale, float(words.x >> 11 & 2047u) * scale,
                 float(words.x >> 22) * (2.f * scale)),
            float(words.y >> 8 & 0xffu) * (1.f / 255.f), unpackSlope(words.y, code)};
}

glm::uvec4 packTexel(const MapTexel& texel, const SlopeCode& code) {
    const glm::uvec2 front = packLayer(texel.layers[0], code), back = packLayer(texel.layers[1], code);
    return {front, back};
}

MapTexel unpackTexel(const glm::uvec4& words, const SlopeCode& code) {
    MapTexel texel{{unpackLayer({words.x, words.y}, code), unpackLayer({words.z, words.w}, code)}};
    while (texel.count < kMapLayers && texel.layers[std::size_t(texel.count)].slope != kNoLayer)
        ++texel.count;
    return texel;
}

} // namespace slant

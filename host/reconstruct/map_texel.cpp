#include "reconstruct/map_texel.h"

#include "reconstruct/kernels.h"

namespace slant {
namespace {

glm::uvec2 pack(const MapLayer& layer, const SlopeCode& code) {
    if (layer.slope == kNoLayer) return kNoLayerWords;
    return packLayer(layer.rgb, layer.coverage, layer.slope, code);
}

MapLayer unpack(glm::uvec2 words, const SlopeCode& code) {
    const vec4 layer = unpackLayer(words);
    return {vec3(layer), layer.w, unpackSlope(words.y, code), vec3(0)};
}

} // namespace

glm::uvec4 packTexel(const MapTexel& texel, const SlopeCode& code) {
    return {pack(texel.layers[0], code), pack(texel.layers[1], code)};
}

glm::uvec4 packMotions(const MapTexel& texel, const MotionLayout& motion) {
    const auto packed = [&](int layer) {
        return layer < texel.count ? packMotion(texel.layers[std::size_t(layer)].motion, motion) : uvec2(0);
    };
    return {packed(0), packed(1)};
}

MapTexel unpackTexel(const glm::uvec4& words, const SlopeCode& code) {
    MapTexel texel{{unpack({words.x, words.y}, code), unpack({words.z, words.w}, code)}};
    while (texel.count < kMapLayers && texel.layers[std::size_t(texel.count)].slope != kNoLayer)
        ++texel.count;
    return texel;
}

} // namespace slant

// A texel of the layer map, and its 16 bytes. As shaders/lib/map_texel.glsl.
#pragma once
#include "shared/layer_map.h"

#include <array>

namespace slant {

/// Codes of the slopes that a grid tells apart.
SlopeCode slopeCode(const GridLayout& grid);

struct MapLayer {
    vec3 rgb{0};        ///< mean radiance
    float coverage = 0; ///< of the texel, in [0, 1]
    float slope = kNoLayer;
};

struct MapTexel {
    std::array<MapLayer, kMapLayers> layers; ///< front to back, the first `count` of them
    int count = 0;
};

/// Two words a layer: 11, 11 and 10 bits of red, green and blue; their common exponent, coverage in 1/255 (at
/// least 1), and slope as a code. Colours are off by at most 1/2048 of the largest (blue: 1/1024), slopes by
/// half a step.
glm::uvec4 packTexel(const MapTexel& texel, const SlopeCode& code);
MapTexel unpackTexel(const glm::uvec4& words, const SlopeCode& code);
/// Of the second word of a layer; kNoLayer without one.
float unpackSlope(uint word, const SlopeCode& code);
MapLayer unpackLayer(glm::uvec2 words, const SlopeCode& code);

} // namespace slant

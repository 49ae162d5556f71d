// A texel of the layer map, and its 16 bytes (shaders/lib/map_texel.glsl).
#pragma once
#include "shared/layer_map.h"
#include "shared/motion.h"

#include <array>

namespace slant {

struct MapLayer {
    vec3 rgb{0};        ///< mean radiance
    float coverage = 0; ///< of the texel, in [0, 1]
    float slope = kNoLayer;
    vec3 motion{0}; ///< velocity, pixels per shutter; depth rate
};

struct MapTexel {
    std::array<MapLayer, kMapLayers> layers; ///< front to back, the first `count` of them
    int count = 0;
};

/// Two words per layer.
glm::uvec4 packTexel(const MapTexel& texel, const SlopeCode& code);
/// Two words per layer, 0 without one.
glm::uvec4 packMotions(const MapTexel& texel, const MotionLayout& motion);
MapTexel unpackTexel(const glm::uvec4& words, const SlopeCode& code);

} // namespace slant

// Bricks as they are in buffers.
#ifndef SLANT_RESOURCES_BRICK_GLSL
#define SLANT_RESOURCES_BRICK_GLSL
#include "shared/reconstruct.h"

Brick brickOf(uvec4 texel) {
    return Brick(texel.x, texel.y, uintBitsToFloat(texel.z), uintBitsToFloat(texel.w));
}
#endif

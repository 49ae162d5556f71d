// How far the pixel filter of a scene looks.
#pragma once
#include "scene/scene.h"

#include <cmath>

namespace slant {

/// Pixels to each side of a pixel whose samples its filter sees.
inline glm::ivec2 filterReach(const PixelFilter& filter) {
    return glm::ivec2(glm::ceil(filter.radius - 0.5f));
}

} // namespace slant

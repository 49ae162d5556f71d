// How far the pixel filter of a scene looks.
#pragma once
#include "scene/scene.h"

#include <cmath>

namespace slant {

/// Pixels to each side of a pixel whose samples its filter sees.
inline glm::ivec2 filterReach(const PixelFilter& filter) {
    return glm::ivec2(glm::ceil(filter.radius - 0.5f));
}

/// The pixels whose samples the filters of a picture's pixels see.
inline Rect filteredPixels(const Rect& frame, const PixelFilter& filter) {
    const glm::ivec2 reach = filterReach(filter);
    return {frame.x0 - reach.x, frame.y0 - reach.y, frame.x1 + reach.x, frame.y1 + reach.y};
}

} // namespace slant

// The scale of a projective camera's screen.
#pragma once
#include "base/error.h"
#include "scene/scene.h"

#include <cmath>

namespace slant {

/// Pixels in `unit`, which the screen window is measured in. Throws Error(badInput) for an empty window, and
/// for pixels that are not square.
inline double pixelsPerUnit(const PerspectiveCamera& camera, const Film& film, double unit) {
    const FileLocation nowhere;
    const glm::dvec2 window = glm::dvec2(camera.screenMax) - glm::dvec2(camera.screenMin);
    if (!(window.x > 0 && window.y > 0)) throw badInput(nowhere, "camera: the screen window is empty");
    const glm::dvec2 scale = glm::dvec2(film.xResolution, film.yResolution) / (window * unit);
    if (std::abs(scale.x - scale.y) > 1e-4 * scale.y)
        throw badInput(nowhere,
                       "camera: pixels are not square: the screen window gives {:.6g} pixels per unit across "
                       "and {:.6g} down; choose screenwindow or frameaspectratio to fit the resolution",
                       film.xResolution / window.x, film.yResolution / window.y);
    return scale.x;
}

} // namespace slant

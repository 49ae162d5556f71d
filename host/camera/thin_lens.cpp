#include "camera/thin_lens.h"

#include "base/error.h"

#include <cmath>
#include <numbers>

namespace slant {

ThinLens::ThinLens(const PerspectiveCamera& camera, const Film& film)
    : aperture_(camera.aperture), worldFromCamera_(camera.worldFromCamera),
      axes_(camera.worldFromCamera.at[0]) {
    FileLocation nowhere;
    if (!(camera.fovDegrees > 0 && camera.fovDegrees < 180))
        throw badInput(nowhere, "camera: fov {} is outside (0, 180) degrees", camera.fovDegrees);
    if (!(camera.lensRadius >= 0) || !std::isfinite(camera.lensRadius))
        throw badInput(nowhere, "camera: lensradius {} is not zero or positive", camera.lensRadius);
    if (camera.lensRadius > 0 && !(camera.focalDistance > 0))
        throw badInput(nowhere, "camera: focaldistance {} is not positive", camera.focalDistance);

    double halfTangent = std::tan(double(camera.fovDegrees) * std::numbers::pi / 360);
    glm::dvec2 window = glm::dvec2(camera.screenMax) - glm::dvec2(camera.screenMin);
    if (!(window.x > 0 && window.y > 0)) throw badInput(nowhere, "camera: the screen window is empty");
    glm::dvec2 scale = glm::dvec2(film.xResolution, film.yResolution) / (window * halfTangent);
    if (std::abs(scale.x - scale.y) > 1e-4 * scale.y)
        throw badInput(nowhere,
                       "camera: pixels are not square: the screen window gives {:.6g} pixels per unit across "
                       "and {:.6g} down; choose screenwindow or frameaspectratio to fit the resolution",
                       film.xResolution / window.x, film.yResolution / window.y);
    pixelsPerTangent_ = scale.x;
    tangentPerPixel_ = float(1 / scale.x);
    tangentOfRasterOrigin_ = glm::dvec2(camera.screenMin.x, -camera.screenMax.y) * halfTangent;
    lensRadius_ = camera.lensRadius;
    inverseFocalDistance_ = camera.lensRadius > 0 ? float(1 / double(camera.focalDistance)) : 0;
}

SlopeModel ThinLens::slopeModel() const {
    double c1 = -pixelsPerTangent_ * double(lensRadius_);
    return {float(c1), float(-c1 * double(inverseFocalDistance_))};
}

glm::dmat4x3 ThinLens::pinholeFromCamera() const {
    const glm::dvec2 centre = -pixelsPerTangent_ * glm::dvec2(tangentOfRasterOrigin_);
    glm::dmat4x3 result(0);
    result[0].x = pixelsPerTangent_;
    result[1].y = -pixelsPerTangent_;
    result[2] = glm::dvec3(centre, 1);
    return result;
}

} // namespace slant

#include "camera/thin_lens.h"

#include "camera/screen_window.h"

#include <cmath>
#include <numbers>

namespace slant {

ThinLens::ThinLens(const PerspectiveCamera& camera, const Film& film)
    : aperture_(camera.aperture), worldFromCamera_(camera.worldFromCamera),
      axes_(camera.worldFromCamera.at[0]) {
    FileLocation nowhere;
    const bool parallel = camera.projection == Projection::parallel;
    if (!parallel && !(camera.fovDegrees > 0 && camera.fovDegrees < 180))
        throw badInput(nowhere, "camera: fov {} is outside (0, 180) degrees", camera.fovDegrees);
    if (!(camera.lensRadius >= 0) || !std::isfinite(camera.lensRadius))
        throw badInput(nowhere, "camera: lensradius {} is not zero or positive", camera.lensRadius);
    if (camera.lensRadius > 0 && !(camera.focalDistance > 0))
        throw badInput(nowhere, "camera: focaldistance {} is not positive", camera.focalDistance);

    // Through the lens of an orthographic camera the screen lies in the plane in focus.
    const double halfTangent = parallel ? 1 / double(camera.focalDistance)
                                        : std::tan(double(camera.fovDegrees) * std::numbers::pi / 360);
    pixelsPerTangent_ = pixelsPerUnit(camera, film, halfTangent);
    tangentPerPixel_ = float(1 / pixelsPerTangent_);
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

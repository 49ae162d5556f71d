// pbrt-v4's spherical camera: a picture of all directions around a point. It has no lens, and nothing that
// moves goes along straight lines in it.
#pragma once
#include "camera/aperture.h"
#include "camera/camera_sample.h"
#include "camera/slope_model.h"
#include "scene/animated_transform.h"

namespace slant {

class SphericalView {
public:
    SphericalView(const PerspectiveCamera& camera, const Film& film)
        : equalArea_(camera.projection == Projection::equalArea),
          resolution_(film.xResolution, film.yResolution), aperture_(camera.aperture),
          worldFromCamera_(camera.worldFromCamera) {}

    /// Its ray's parameter is the distance from the camera.
    CameraSample sample(glm::vec2 raster, glm::vec2 square, float time = 0) const;
    SlopeModel slopeModel() const { return {}; }
    const Aperture& aperture() const { return aperture_; }
    const AnimatedTransform& worldFromCamera() const { return worldFromCamera_; }
    /// Of the middle of the picture only; nothing there is a straight projection.
    glm::dmat4x3 pinholeFromCamera() const { return glm::dmat4x3(0); }

private:
    bool equalArea_;
    glm::vec2 resolution_;
    Aperture aperture_;
    AnimatedTransform worldFromCamera_;
};

} // namespace slant

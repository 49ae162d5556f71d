// pbrt-v4's perspective camera: a thin lens in the plane z = 0 of a left-handed camera space that looks along
// +z, and the slopes of trajectories seen through it.
#pragma once
#include "camera/aperture.h"
#include "camera/camera_sample.h"
#include "camera/disc.h"
#include "camera/slope_model.h"
#include "scene/scene.h"

#include <glm/glm.hpp>

namespace slant {

class ThinLens {
public:
    /// Throws Error(badInput) for a field of view outside (0, 180) degrees, a focal distance that is not
    /// positive, pixels that are not square, a moving camera.
    ThinLens(const PerspectiveCamera& camera, const Film& film);

    /// `raster` in pixels, y downwards; `lens` in the unit disc, v downwards (to the right and down, like the
    /// raster).
    CameraRay ray(glm::vec2 raster, glm::vec2 lens) const {
        glm::vec2 tangent = tangentOfRasterOrigin_ + raster * tangentPerPixel_;
        glm::vec2 onLens = lens * lensRadius_;
        return {centre_ + right_ * onLens.x + down_ * onLens.y,
                forward_ + right_ * (tangent.x - onLens.x * inverseFocalDistance_) +
                    down_ * (tangent.y - onLens.y * inverseFocalDistance_)};
    }

    /// The same for `square` in [0, 1)^2, spread over the lens as light passes through its aperture. Every
    /// weight is 1: brightness does not depend on how much of the lens is open, as in pbrt.
    CameraSample sample(glm::vec2 raster, glm::vec2 square) const {
        const glm::vec2 lens =
            aperture_.isDisc() ? concentricDisc(square.x, square.y) : aperture_.at(2.f * square - 1.f);
        return {ray(raster, lens), lens, 1};
    }

    /// c1 = -S A, c2 = S A / f with S = pixelsPerTangent.
    SlopeModel slopeModel() const;
    const Aperture& aperture() const { return aperture_; }
    /// Raster pixels per unit tangent from the viewing axis.
    double pixelsPerTangent() const { return pixelsPerTangent_; }

private:
    double pixelsPerTangent_ = 0;
    Aperture aperture_;
    float lensRadius_ = 0, inverseFocalDistance_ = 0, tangentPerPixel_ = 0;
    glm::vec2 tangentOfRasterOrigin_{0};
    glm::vec3 centre_{0}, right_{0}, down_{0}, forward_{0}; ///< world space, unit in camera space
};

} // namespace slant

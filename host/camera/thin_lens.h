// pbrt-v4's perspective camera: a thin lens in the plane z = 0 of a left-handed camera space that looks along
// +z, and the slopes of trajectories seen through it.
#pragma once
#include "camera/aperture.h"
#include "camera/camera_sample.h"
#include "camera/disc.h"
#include "camera/slope_model.h"
#include "scene/animated_transform.h"

#include <glm/glm.hpp>

namespace slant {

class ThinLens {
public:
    /// Throws Error(badInput) for a field of view outside (0, 180) degrees, a focal distance that is not
    /// positive, pixels that are not square.
    ThinLens(const PerspectiveCamera& camera, const Film& film);

    /// `raster` in pixels, y downwards; `lens` in the unit disc, v downwards (to the right and down, like the
    /// raster); `time` of the shutter, in [0, 1].
    CameraRay ray(glm::vec2 raster, glm::vec2 lens, float time = 0) const {
        if (worldFromCamera_.moves()) return ray(raster, lens, Axes(worldFromCamera_.at(double(time))));
        return ray(raster, lens, axes_);
    }

    /// The same for `square` in [0, 1)^2, spread over the lens as light passes through its aperture. Every
    /// weight is 1: brightness does not depend on how much of the lens is open, as in pbrt.
    CameraSample sample(glm::vec2 raster, glm::vec2 square, float time = 0) const {
        const glm::vec2 lens =
            aperture_.isDisc() ? concentricDisc(square.x, square.y) : aperture_.at(2.f * square - 1.f);
        return {ray(raster, lens, time), lens, 1};
    }

    /// c1 = -S A, c2 = S A / f with S = pixelsPerTangent.
    SlopeModel slopeModel() const;
    const Aperture& aperture() const { return aperture_; }
    /// Raster pixels per unit tangent from the viewing axis.
    double pixelsPerTangent() const { return pixelsPerTangent_; }

    const AnimatedTransform& worldFromCamera() const { return worldFromCamera_; }
    /// (x w, y w, w) of a point in camera space, x and y being where the middle of the lens sees it.
    glm::dmat4x3 pinholeFromCamera() const;

private:
    /// World space, unit in camera space.
    struct Axes {
        explicit Axes(const glm::dmat4& m) : centre(m[3]), right(m[0]), down(-m[1]), forward(m[2]) {}
        glm::vec3 centre, right, down, forward;
    };
    CameraRay ray(glm::vec2 raster, glm::vec2 lens, const Axes& axes) const {
        glm::vec2 tangent = tangentOfRasterOrigin_ + raster * tangentPerPixel_;
        glm::vec2 onLens = lens * lensRadius_;
        return {axes.centre + axes.right * onLens.x + axes.down * onLens.y,
                axes.forward + axes.right * (tangent.x - onLens.x * inverseFocalDistance_) +
                    axes.down * (tangent.y - onLens.y * inverseFocalDistance_)};
    }

    double pixelsPerTangent_ = 0;
    Aperture aperture_;
    float lensRadius_ = 0, inverseFocalDistance_ = 0, tangentPerPixel_ = 0;
    glm::vec2 tangentOfRasterOrigin_{0};
    AnimatedTransform worldFromCamera_;
    Axes axes_; ///< if it does not move
};

} // namespace slant

// pbrt-v4's realistic camera: the film behind a lens of many surfaces, through which every ray is followed.
//
// Lens coordinates are places on the exit pupil's plane. Between lens and film rays are straight, so the rays
// of a sharply imaged point cross film and pupil plane in places that are linear in each other, whatever
// happens within the lens: trajectories are straight up to the lens's aberrations. They count from the axis,
// in units of the farthest place that the pupil reaches from any part of the film.
//
// Rays are chosen evenly over the true pupil of each film point, and their radiance is multiplied by the
// irradiance that the whole pupil gives there, cos^4 area / distance^2: the expectation of pbrt's estimate,
// without the third of its rays that a lens blocks.
#pragma once
#include "camera/camera_sample.h"
#include "camera/exit_pupil.h"
#include "camera/lens_system.h"

namespace slant {

/// Depths count from the entrance pupil, but at most from the front vertex, in camera space (metres).
class CompoundLens {
public:
    /// Throws Error(badInput) for a lens that forms no image or cannot focus as asked, a moving camera.
    CompoundLens(const RealisticCamera& camera, const MovingTransform& worldFromCamera, const Film& film);

    /// `raster` in pixels, y downwards, on the film or beside it; `square` in [0, 1)^2.
    CameraSample sample(glm::vec2 raster, glm::vec2 square) const;

    SlopeModel slopeModel() const;

    const LensSystem& lens() const { return lens_; }
    const ExitPupil& pupil() const { return pupil_; }
    double filmZ() const { return filmZ_; }             ///< in lens space, mm
    double depthOrigin() const { return depthOrigin_; } ///< the same
    double millimetresPerPixel() const { return mmPerPixel_; }

private:
    SlopeModel slopeOf(const LensRay& ray, std::span<const LensRayDerivative> derivatives) const;
    LensRay filmRay(glm::dvec2 film, glm::dvec2 pupil) const;

    LensSystem lens_;
    double filmZ_, mmPerPixel_;
    ExitPupil pupil_;
    double depthOrigin_;
    glm::dvec2 filmCentre_; ///< raster
    glm::dvec3 centre_{0}, right_{0}, down_{0},
        forward_{0}; ///< world space: depth 0 on the axis; mm of lens space
};

} // namespace slant

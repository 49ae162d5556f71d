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
#include "camera/slope_fit.h"

#include <optional>

namespace slant {

/// A ray on the side of the scene, in metres to the right and down of the axis: `position` + w * `tangent` at
/// depth w. `change` says how it changes along raster x, y (pixels) and lens u, v.
struct ScenePath {
    struct Line {
        glm::dvec2 position, tangent;
        glm::dvec2 at(double depth) const { return position + depth * tangent; }
    };
    Line line;
    std::array<Line, 4> change;
};

/// How the raster position changes with the lens position at which a point of the ray is seen, `inverseDepth`
/// = 1 / depth, in pixels per lens radius.
glm::dmat2 slopeMatrix(const ScenePath& path, double inverseDepth);
/// The mean of the slopes along two directions at a right angle: half the trace of that matrix.
SlopeModel isotropicSlope(const ScenePath& path);

/// Depths count from the entrance pupil, but at most from the front vertex, in camera space (metres).
class CompoundLens {
public:
    /// Throws Error(badInput) for a lens that forms no image or cannot focus as asked, a moving camera.
    CompoundLens(const RealisticCamera& camera, const MovingTransform& worldFromCamera, const Film& film);

    /// `raster` in pixels, y downwards, on the film or beside it; `square` in [0, 1)^2.
    CameraSample sample(glm::vec2 raster, glm::vec2 square) const;

    /// Of the lens as a whole.
    SlopeModel slopeModel() const;
    /// Measures how well each rung of the ladder predicts trajectories of points from `nearDepth` to
    /// `farDepth` (may be infinite), and has samples carry slopes of the lowest one that is within the
    /// tolerance by its 95th percentile, or else of the best.
    void chooseSlopes(double nearDepth, double farDepth, double tolerancePx = kSlopeTolerancePx);
    SlopeRung slopeRung() const { return rung_; }
    /// What was told to chooseSlopes; before, from half the distance in focus to infinity.
    double nearDepth() const { return nearDepth_; }
    double farDepth() const { return farDepth_; }

    /// The ray through a raster position and a lens position; nothing if it is blocked.
    std::optional<ScenePath> path(glm::dvec2 raster, glm::dvec2 lens) const;

    const LensSystem& lens() const { return lens_; }
    const ExitPupil& pupil() const { return pupil_; }
    double filmZ() const { return filmZ_; }             ///< in lens space, mm
    double depthOrigin() const { return depthOrigin_; } ///< the same
    double focusDepth() const { return focusDepth_; }   ///< metres
    double millimetresPerPixel() const { return mmPerPixel_; }
    glm::dvec2 filmCentre() const { return filmCentre_; } ///< raster
    const SlopeFit& slopeFit() const { return slopes_; }

private:
    LensRay filmRay(glm::dvec2 film, glm::dvec2 pupil) const;
    bool traceWithDerivatives(LensRay& ray, std::array<LensRayDerivative, 4>& derivatives) const;
    ScenePath scenePath(const LensRay& ray, const std::array<LensRayDerivative, 4>& derivatives) const;

    LensSystem lens_;
    double filmZ_, mmPerPixel_;
    ExitPupil pupil_;
    double depthOrigin_, focusDepth_, nearDepth_, farDepth_;
    glm::dvec2 filmCentre_;
    SlopeFit slopes_;
    SlopeRung rung_ = SlopeRung::filmRadius;
    // World space: the place of depth 0 on the axis, and a millimetre of lens space along its axes.
    glm::dvec3 centre_{0}, right_{0}, down_{0}, forward_{0};
};

} // namespace slant

// pbrt-v4's realistic camera: the film behind a compound lens, through which every ray is traced.
//
// Lens positions are places in the unit disc, which stands for the true pupil of each film point, with the
// light that comes through it spread evenly (exit_pupil.h). So all rays of a film point have the same weight,
// the irradiance from the whole pupil: the expectation of pbrt's estimate cos^4 area / distance^2, without
// the third of its rays that a lens blocks. The lens map describes the trajectories of scene points
// (lens_map.h).
//
// For an opening of another shape the disc is that of the stop (stop_pupil.h), positions are spread as the
// shape lets light pass, and each ray is weighted by the irradiance of its place. As in pbrt, shapes are as
// bright as the disc on the axis: the mean over the shape takes the place of that over the disc.
#pragma once
#include "camera/aperture.h"
#include "camera/camera_sample.h"
#include "camera/exit_pupil.h"
#include "camera/lens_map.h"
#include "camera/lens_system.h"
#include "camera/slope_model.h"
#include "camera/stop_pupil.h"
#include "scene/animated_transform.h"

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

/// Whether the rims of surfaces, the stop's included, block rays that pass outside.
enum class Rims { block, ignore };

/// Depths count from the entrance pupil, but at most from the front vertex, in camera space (metres).
class CompoundLens {
public:
    /// Throws Error(badInput) for a lens that forms no image or cannot focus as asked.
    CompoundLens(const RealisticCamera& camera, const MovingTransform& worldFromCamera, const Film& film);

    /// `raster` in pixels, y downwards, on the film or beside it; `square` in [0, 1)^2; `time` of the
    /// shutter.
    CameraSample sample(glm::vec2 raster, glm::vec2 square, float time = 0) const;

    /// Slope of trajectories on the scene's side: c1 / depth + c2.
    SlopeModel slopeModel() const { return slopeModel_; }
    const LensMap& lensMap() const { return lensMap_; }
    /// Where a ray meets the plane in focus, in pixels from the film's centre, and the plane of the entrance
    /// pupil, in its radii: what the lens map tabulates.
    glm::dvec2 sceneRay(const ScenePath::Line& line) const {
        return pixelsPerTangent_ / focusDepth_ * line.at(focusDepth_);
    }
    glm::dvec2 entrancePupilPlace(const ScenePath::Line& line) const { return line.position / pupilRadius_; }

    /// The ray through a raster position and a place on the exit pupil's plane, in units of its radius;
    /// nothing if it is blocked. `change` is along these.
    std::optional<ScenePath> path(glm::dvec2 raster, glm::dvec2 pupil, Rims rims = Rims::block) const;

    const AnimatedTransform& worldFromCamera() const { return worldFromCamera_; }
    /// (x w, y w, w) of a point in camera space, on the scene's side: x and y as the lens map has xy, seen
    /// from the middle of the entrance pupil.
    glm::dmat4x3 pinholeFromCamera() const;

    const LensSystem& lens() const { return lens_; }
    const Aperture& aperture() const { return aperture_; }
    const ExitPupil& pupil() const { return pupil_; }
    /// Set unless the aperture is the disc.
    const std::optional<StopPupil>& stopPupil() const { return stopPupil_; }
    double filmZ() const { return filmZ_; }             ///< in lens space, mm
    double depthOrigin() const { return depthOrigin_; } ///< the same
    double focusDepth() const { return focusDepth_; }   ///< metres
    double millimetresPerPixel() const { return mmPerPixel_; }
    glm::dvec2 filmCentre() const { return filmCentre_; } ///< raster

private:
    LensRay filmRay(glm::dvec2 film, glm::dvec2 pupil) const;
    /// World space: the place of depth 0 on the axis, and a millimetre of lens space along its axes.
    struct Axes {
        glm::dvec3 centre, right, down, forward;
    };
    Axes axesOf(const glm::dmat4& worldFromCamera) const;
    CameraSample sample(glm::vec2 raster, glm::vec2 square, const Axes& axes) const;
    CameraSample throughStop(glm::vec2 raster, glm::vec2 square, const Axes& axes) const;
    static CameraSample dark(glm::vec2 lens, const Axes& axes);
    CameraSample inWorld(const LensRay& ray, glm::vec2 lens, float weight, const Axes& axes) const;

    LensSystem lens_;
    double filmZ_, mmPerPixel_;
    ExitPupil pupil_;
    Aperture aperture_;
    std::optional<StopPupil> stopPupil_;
    double depthOrigin_, focusDepth_;
    glm::dvec2 filmCentre_;
    double pixelsPerTangent_ = 0, pupilRadius_ = 0; ///< on the axis, the latter in metres
    SlopeModel slopeModel_;
    LensMap lensMap_;
    AnimatedTransform worldFromCamera_;
    Axes axes_; ///< if it does not move
};

} // namespace slant

#include "camera/compound_lens.h"

#include "base/error.h"
#include "camera/disc.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace slant {
namespace {

constexpr double kMillimetres = 1000; ///< a metre
/// The pupil is known this far beyond the corners of the film, for overscan; farther out the film is dark.
constexpr double kFilmReach = 2;
/// Rays that leave the lens at a right angle to its axis or backwards have no depth.
constexpr double kMinForward = 1e-3;
/// Where interpolation puts a ray outside the pupil, it moves this much nearer to the centre, repeatedly.
constexpr float kInwards = 0.98f;
constexpr int kInwardSteps = 8;

/// Along a film radius and across it.
class RadialFrame {
public:
    explicit RadialFrame(glm::dvec2 offset)
        : radial_(offset == glm::dvec2(0) ? glm::dvec2(1, 0) : offset / glm::length(offset)) {}

    glm::dvec2 to(glm::dvec2 v) const { return turned(v, {radial_.x, -radial_.y}); }
    glm::dvec2 from(glm::dvec2 v) const { return turned(v, radial_); }

private:
    static glm::dvec2 turned(glm::dvec2 v, glm::dvec2 by) {
        return {v.x * by.x - v.y * by.y, v.x * by.y + v.y * by.x};
    }

    glm::dvec2 radial_;
};

/// From the film to the plane in focus, in metres.
double focusDistance(const RealisticCamera& camera, const LensSystem& lens) {
    if (!camera.filmDistanceMm) return camera.focusDistance;
    return lens.focusDistance(*camera.filmDistanceMm, camera.focusLocation) / kMillimetres;
}

} // namespace

CompoundLens::CompoundLens(const RealisticCamera& camera, const MovingTransform& worldFromCamera,
                           const Film& film)
    : lens_(camera.lens, camera.apertureDiameterMm),
      filmZ_(lens_.filmPosition(focusDistance(camera, lens_) * kMillimetres, camera.focusLocation)),
      mmPerPixel_(double(film.diagonalMm) / std::hypot(film.xResolution, film.yResolution)),
      pupil_(lens_, filmZ_, kFilmReach * double(film.diagonalMm) / 2), aperture_(camera.aperture),
      depthOrigin_(std::clamp(lens_.entrancePupil().z, filmZ_, lens_.frontVertex())),
      focusDepth_(focusDistance(camera, lens_) - (depthOrigin_ - filmZ_) / kMillimetres),
      filmCentre_(film.xResolution / 2.0, film.yResolution / 2.0), worldFromCamera_(worldFromCamera),
      axes_(axesOf(worldFromCamera.at[0])) {
    if (!(pupil_.radius() > 0))
        throw badInput({camera.lens.path}, "the lens forms no image: no ray gets through to the middle of "
                                           "the film");
    const glm::dvec2 rim = pupil_.node(0, 0, PupilNodes::kDistances) / pupil_.radius();
    const auto axis = path(filmCentre_, {0, 0}), edge = path(filmCentre_, rim);
    if (!axis || !edge)
        throw badInput({camera.lens.path}, "the lens forms no image in the middle of the film");
    pixelsPerTangent_ = focusDepth_ / axis->change[0].at(focusDepth_).x;
    pupilRadius_ = glm::length(edge->line.position);
    const double c1 = -pixelsPerTangent_ * pupilRadius_;
    slopeModel_ = {float(c1), float(-c1 / focusDepth_)};
    if (!aperture_.isDisc()) stopPupil_.emplace(lens_, filmZ_, pupil_);
    lensMap_ = makeLensMap(*this);
}

/// Both in the plane across the axis, in millimetres.
LensRay CompoundLens::filmRay(glm::dvec2 film, glm::dvec2 pupil) const {
    const glm::dvec3 from(film, filmZ_), to(pupil, pupil_.planeZ());
    return {from, glm::normalize(to - from)};
}

std::optional<ScenePath> CompoundLens::path(glm::dvec2 raster, glm::dvec2 pupil, Rims rims) const {
    LensRay ray = filmRay((filmCentre_ - raster) * mmPerPixel_, pupil * pupil_.radius());
    std::array<LensRayDerivative, 4> derivatives;
    const double distance = (pupil_.planeZ() - filmZ_) / ray.direction.z;
    for (int i = 0; i < 4; ++i) { // raster x, y, lens u, v; the film is upside down
        glm::dvec3 step(0);
        step[i % 2] = i < 2 ? mmPerPixel_ : pupil_.radius();
        const glm::dvec3 turn = (step - ray.direction * glm::dot(ray.direction, step)) / distance;
        derivatives[std::size_t(i)] = {i < 2 ? -step : glm::dvec3(0), turn};
    }
    const bool through = rims == Rims::block ? lens_.traceFromFilm(ray, derivatives)
                                             : lens_.traceBesideRims(ray, derivatives).has_value();
    if (!through || ray.direction.z < kMinForward) return std::nullopt;
    const glm::dvec2 tangent = glm::dvec2(ray.direction) / ray.direction.z;
    const double t = (depthOrigin_ - ray.origin.z) / ray.direction.z;
    ScenePath path;
    path.line = {glm::dvec2(ray.origin + t * ray.direction) / kMillimetres, tangent};
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::dvec3 moved = derivatives[i].origin + t * derivatives[i].direction;
        const glm::dvec3 turned = derivatives[i].direction;
        path.change[i] = {(glm::dvec2(moved) - tangent * moved.z) / kMillimetres,
                          (glm::dvec2(turned) - tangent * turned.z) / ray.direction.z};
    }
    return path;
}

CompoundLens::Axes CompoundLens::axesOf(const glm::dmat4& m) const {
    const glm::dvec3 forward = glm::dvec3(m[2]) / kMillimetres;
    return {glm::dvec3(m[3]) + forward * (depthOrigin_ - filmZ_), glm::dvec3(m[0]) / kMillimetres,
            -glm::dvec3(m[1]) / kMillimetres, forward};
}

glm::dmat4x3 CompoundLens::pinholeFromCamera() const {
    glm::dmat4x3 result(0);
    result[0].x = pixelsPerTangent_;
    result[1].y = -pixelsPerTangent_;
    result[2] = glm::dvec3(filmCentre_, 1);
    result[3] = -(depthOrigin_ - filmZ_) / kMillimetres * result[2];
    return result;
}

CameraSample CompoundLens::dark(glm::vec2 lens, const Axes& axes) {
    return {{glm::vec3(axes.centre), glm::vec3(axes.forward * kMillimetres)}, lens, 0};
}

/// `ray` has left the lens.
CameraSample CompoundLens::inWorld(const LensRay& ray, glm::vec2 lens, float weight, const Axes& axes) const {
    if (ray.direction.z < kMinForward) return dark(lens, axes);
    const glm::dvec3 direction = ray.direction / ray.direction.z;
    const glm::dvec3 origin = ray.origin + (depthOrigin_ - ray.origin.z) * direction;
    const auto world = [&](glm::dvec3 v) { return axes.right * v.x + axes.down * v.y; };
    return {
        {glm::vec3(axes.centre + world(origin)), glm::vec3((axes.forward + world(direction)) * kMillimetres)},
        lens,
        weight};
}

CameraSample CompoundLens::sample(glm::vec2 raster, glm::vec2 square, float time) const {
    if (worldFromCamera_.moves()) return sample(raster, square, axesOf(worldFromCamera_.at(double(time))));
    return sample(raster, square, axes_);
}

CameraSample CompoundLens::sample(glm::vec2 raster, glm::vec2 square, const Axes& axes) const {
    if (stopPupil_) return throughStop(raster, square, axes);
    const glm::dvec2 offset = (glm::dvec2(raster) - filmCentre_) * mmPerPixel_;
    const double r = glm::length(offset), irradiance = pupil_.irradiance(r);
    if (!(irradiance > 0)) return dark(glm::vec2(0), axes);
    const RadialFrame frame(offset);
    glm::vec2 lens = concentricDisc(square.x, square.y);
    for (int step = 0; step < kInwardSteps; ++step, lens *= kInwards) {
        LensRay ray = filmRay(-offset, frame.from(pupil_.at(r, frame.to(lens))));
        if (lens_.traceFromFilm(ray)) return inWorld(ray, lens, float(irradiance), axes);
    }
    return dark(glm::vec2(0), axes);
}

/// The map decides what is open, so that reconstruction finds the same.
CameraSample CompoundLens::throughStop(glm::vec2 raster, glm::vec2 square, const Axes& axes) const {
    const glm::vec2 lens = aperture_.at(2.f * square - 1.f);
    const float weight = lensMap_.at(raster, lens).weight;
    if (!(weight > 0)) return dark(lens, axes);
    const glm::dvec2 offset = (glm::dvec2(raster) - filmCentre_) * mmPerPixel_;
    const RadialFrame frame(offset);
    LensRay ray = filmRay(-offset, frame.from(stopPupil_->at(glm::length(offset), frame.to(lens))));
    return lens_.traceBesideRims(ray) ? inWorld(ray, lens, weight, axes) : dark(lens, axes);
}

} // namespace slant

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
constexpr double kLeastForward = 1e-3;
/// Where interpolation puts a ray outside the pupil, it is taken this much nearer to the centre, and so on.
constexpr float kInwards = 0.98f;
constexpr int kInwardSteps = 8;

} // namespace

CompoundLens::CompoundLens(const RealisticCamera& camera, const MovingTransform& worldFromCamera,
                           const Film& film)
    : lens_(camera.lens, camera.apertureDiameterMm),
      filmZ_(lens_.filmPosition(camera.focusDistance * kMillimetres, camera.focusLocation)),
      mmPerPixel_(double(film.diagonalMm) / std::hypot(film.xResolution, film.yResolution)),
      pupil_(lens_, filmZ_, kFilmReach * double(film.diagonalMm) / 2),
      depthOrigin_(std::clamp(lens_.entrancePupil().z, filmZ_, lens_.frontVertex())),
      focusDepth_(camera.focusDistance - (depthOrigin_ - filmZ_) / kMillimetres),
      filmCentre_(film.xResolution / 2.0, film.yResolution / 2.0) {
    if (worldFromCamera.moves()) throw badInput({}, "camera: a moving camera is not supported");
    if (!(pupil_.radius() > 0))
        throw badInput({camera.lens.path}, "the lens forms no image: no ray gets through to the middle of "
                                           "the film");
    const glm::dmat4& m = worldFromCamera.at[0];
    right_ = glm::dvec3(m[0]) / kMillimetres;
    down_ = -glm::dvec3(m[1]) / kMillimetres;
    forward_ = glm::dvec3(m[2]) / kMillimetres;
    centre_ = glm::dvec3(m[3]) + forward_ * (depthOrigin_ - filmZ_);

    const glm::dvec2 rim = pupil_.node(0, 0, PupilNodes::kDistances) / pupil_.radius();
    const auto axis = path(filmCentre_, {0, 0}), edge = path(filmCentre_, rim);
    if (!axis || !edge)
        throw badInput({camera.lens.path}, "the lens forms no image in the middle of the film");
    pixelsPerTangent_ = focusDepth_ / axis->change[0].at(focusDepth_).x;
    pupilRadius_ = glm::length(edge->line.position);
    const double c1 = -pixelsPerTangent_ * pupilRadius_;
    slopeModel_ = {float(c1), float(-c1 / focusDepth_)};
    lensMap_ = makeLensMap(*this);
}

/// Both in the plane across the axis, in millimetres.
LensRay CompoundLens::filmRay(glm::dvec2 film, glm::dvec2 pupil) const {
    const glm::dvec3 from(film, filmZ_), to(pupil, pupil_.planeZ());
    return {from, glm::normalize(to - from)};
}

/// `ray` starts at the film.
bool CompoundLens::traceWithDerivatives(LensRay& ray, std::array<LensRayDerivative, 4>& derivatives) const {
    const glm::dvec3 d = ray.direction;
    const double distance = (pupil_.planeZ() - filmZ_) / d.z;
    for (int i = 0; i < 4; ++i) { // raster x, y, lens u, v; the film is upside down
        glm::dvec3 step(0);
        step[i % 2] = i < 2 ? mmPerPixel_ : pupil_.radius();
        const glm::dvec3 turn = (step - d * glm::dot(d, step)) / distance;
        derivatives[std::size_t(i)] = {i < 2 ? -step : glm::dvec3(0), turn};
    }
    return lens_.traceFromFilm(ray, derivatives);
}

std::optional<ScenePath> CompoundLens::path(glm::dvec2 raster, glm::dvec2 pupil) const {
    LensRay ray = filmRay((filmCentre_ - raster) * mmPerPixel_, pupil * pupil_.radius());
    std::array<LensRayDerivative, 4> derivatives;
    if (!traceWithDerivatives(ray, derivatives) || ray.direction.z < kLeastForward) return std::nullopt;
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

CameraSample CompoundLens::sample(glm::vec2 raster, glm::vec2 square) const {
    const CameraSample dark{{glm::vec3(centre_), glm::vec3(forward_ * kMillimetres)}, glm::vec2(0), 0};
    const glm::dvec2 offset = (glm::dvec2(raster) - filmCentre_) * mmPerPixel_;
    const double r = glm::length(offset), irradiance = pupil_.irradiance(r);
    if (!(irradiance > 0)) return dark;
    const glm::dvec2 radial = r > 0 ? offset / r : glm::dvec2(1, 0);
    const auto turned = [](glm::dvec2 v, glm::dvec2 by) {
        return glm::dvec2(v.x * by.x - v.y * by.y, v.x * by.y + v.y * by.x);
    };
    glm::vec2 lens = concentricDisc(square.x, square.y);
    for (int step = 0; step < kInwardSteps; ++step, lens *= kInwards) {
        const glm::dvec2 inFrame = turned(lens, {radial.x, -radial.y});
        LensRay ray = filmRay(-offset, turned(pupil_.at(r, inFrame), radial));
        if (!lens_.traceFromFilm(ray)) continue;
        if (ray.direction.z < kLeastForward) return dark;
        const glm::dvec3 direction = ray.direction / ray.direction.z;
        const glm::dvec3 origin = ray.origin + (depthOrigin_ - ray.origin.z) * direction;
        const auto world = [&](glm::dvec3 v) { return right_ * v.x + down_ * v.y; };
        return {{glm::vec3(centre_ + world(origin)), glm::vec3((forward_ + world(direction)) * kMillimetres)},
                lens,
                float(irradiance)};
    }
    return dark;
}

} // namespace slant

#include "camera/compound_lens.h"

#include "base/error.h"
#include "camera/slope_residual.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace slant {
namespace {

constexpr double kMillimetres = 1000; ///< a metre
/// The pupil is known this far beyond the corners of the film, for overscan; farther out the film is dark.
constexpr double kFilmReach = 2;
/// Rays that leave the lens at a right angle to its axis or backwards have no depth.
constexpr double kLeastForward = 1e-3;
/// Where interpolation puts a ray outside the pupil, it is taken this much nearer to the centre, and so on.
constexpr double kInwards = 0.98;
constexpr int kInwardSteps = 8;

} // namespace

CompoundLens::CompoundLens(const RealisticCamera& camera, const MovingTransform& worldFromCamera,
                           const Film& film)
    : lens_(camera.lens, camera.apertureDiameterMm),
      filmZ_(lens_.filmPosition(camera.focusDistance * kMillimetres, camera.focusLocation)),
      mmPerPixel_(double(film.diagonalMm) / std::hypot(film.xResolution, film.yResolution)),
      pupil_(lens_, filmZ_, kFilmReach * double(film.diagonalMm) / 2),
      depthOrigin_(std::clamp(lens_.entrancePupil().z, filmZ_, lens_.frontVertex())),
      focusDepth_(camera.focusDistance - (depthOrigin_ - filmZ_) / kMillimetres), nearDepth_(focusDepth_ / 2),
      farDepth_(std::numeric_limits<double>::infinity()),
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
    slopes_ = fitSlopes(*this, nearDepth_, farDepth_);
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

ScenePath CompoundLens::scenePath(const LensRay& ray,
                                  const std::array<LensRayDerivative, 4>& derivatives) const {
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

std::optional<ScenePath> CompoundLens::path(glm::dvec2 raster, glm::dvec2 lens) const {
    LensRay ray = filmRay((filmCentre_ - raster) * mmPerPixel_, lens * pupil_.radius());
    std::array<LensRayDerivative, 4> derivatives;
    if (!traceWithDerivatives(ray, derivatives) || ray.direction.z < kLeastForward) return std::nullopt;
    return scenePath(ray, derivatives);
}

CameraSample CompoundLens::sample(glm::vec2 raster, glm::vec2 square) const {
    const CameraSample dark{{glm::vec3(centre_), glm::vec3(forward_ * kMillimetres)}, glm::vec2(0), 0, {}};
    const glm::dvec2 offset = (glm::dvec2(raster) - filmCentre_) * mmPerPixel_;
    const double r = glm::length(offset);
    const glm::dvec2 radial = r > 0 ? offset / r : glm::dvec2(1, 0);
    const ExitPupil::Point point = pupil_.sample(r, square);
    if (!(point.area > 0)) return dark;

    glm::dvec2 fromCentre = point.position - point.centre;
    for (int step = 0; step < kInwardSteps; ++step, fromCentre *= kInwards) {
        const glm::dvec2 p = point.centre + fromCentre;
        const glm::dvec2 pupil(radial.x * p.x - radial.y * p.y, radial.y * p.x + radial.x * p.y);
        const LensRay filmSide = filmRay(-offset, pupil);
        LensRay ray = filmSide;
        std::array<LensRayDerivative, 4> derivatives;
        const bool exact = rung_ == SlopeRung::sample;
        if (!(exact ? traceWithDerivatives(ray, derivatives) : lens_.traceFromFilm(ray))) continue;
        if (ray.direction.z < kLeastForward) return dark;

        const double cosine = filmSide.direction.z, z = pupil_.planeZ() - filmZ_;
        const glm::dvec3 direction = ray.direction / ray.direction.z;
        const glm::dvec3 origin = ray.origin + (depthOrigin_ - ray.origin.z) * direction;
        const auto world = [&](glm::dvec3 v) { return right_ * v.x + down_ * v.y; };
        return {{glm::vec3(centre_ + world(origin)), glm::vec3((forward_ + world(direction)) * kMillimetres)},
                glm::vec2(pupil / pupil_.radius()),
                float(cosine * cosine * cosine * cosine * point.area / (z * z)),
                exact ? isotropicSlope(scenePath(ray, derivatives))
                      : slopes_.at(rung_, r / mmPerPixel_).mean()};
    }
    return dark;
}

void CompoundLens::chooseSlopes(double nearDepth, double farDepth, double tolerancePx) {
    nearDepth_ = nearDepth;
    farDepth_ = farDepth;
    slopes_ = fitSlopes(*this, nearDepth, farDepth);
    rung_ = selectRung(slopeResiduals(*this, nearDepth, farDepth), tolerancePx);
}

SlopeModel CompoundLens::slopeModel() const {
    return slopes_.at(SlopeRung::lens, 0).mean();
}

// A point seen at depth w stays where it is while the lens position moves by du: with Q = position + w *
// tangent, dQ/dx dx + dQ/du du = 0. Below, q = 1 / w and X + q X' = dQ/dx / w, U likewise.

glm::dmat2 slopeMatrix(const ScenePath& path, double inverseDepth) {
    const auto column = [&](std::size_t i) {
        return path.change[i].tangent + inverseDepth * path.change[i].position;
    };
    return -(glm::inverse(glm::dmat2(column(0), column(1))) * glm::dmat2(column(2), column(3)));
}

SlopeModel isotropicSlope(const ScenePath& path) {
    const auto det = [](glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; };
    // By Cramer's rule trace(X^-1 U) = (det(U_0, X_1) + det(X_0, U_1)) / det(X_0, X_1), each a polynomial in
    // q.
    std::array<double, 3> top{}, bottom{};
    const auto add = [&](std::array<double, 3>& sum, std::size_t i, std::size_t j, double factor) {
        const ScenePath::Line &a = path.change[i], &b = path.change[j];
        sum[0] += factor * det(a.tangent, b.tangent);
        sum[1] += factor * (det(a.tangent, b.position) + det(a.position, b.tangent));
        sum[2] += factor * det(a.position, b.position);
    };
    add(top, 2, 1, -0.5);
    add(top, 0, 3, -0.5);
    add(bottom, 0, 1, 1);
    return {float(top[1] / bottom[0]), float(top[0] / bottom[0]), float(top[2] / bottom[0]),
            float(bottom[1] / bottom[0]), float(bottom[2] / bottom[0])};
}

} // namespace slant

#include "camera/compound_lens.h"

#include "base/error.h"

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
}

/// Both in the plane across the axis, in millimetres.
LensRay CompoundLens::filmRay(glm::dvec2 film, glm::dvec2 pupil) const {
    const glm::dvec3 from(film, filmZ_), to(pupil, pupil_.planeZ());
    return {from, glm::normalize(to - from)};
}

CameraSample CompoundLens::sample(glm::vec2 raster, glm::vec2 square) const {
    const CameraSample dark{{glm::vec3(centre_), glm::vec3(forward_)}, glm::vec2(0), 0, {}};
    const glm::dvec2 offset = (glm::dvec2(raster) - filmCentre_) * mmPerPixel_, film = -offset;
    const double r = glm::length(offset);
    const glm::dvec2 radial = r > 0 ? offset / r : glm::dvec2(1, 0);
    const auto turned = [&](glm::dvec2 p) {
        return glm::dvec2(radial.x * p.x - radial.y * p.y, radial.y * p.x + radial.x * p.y);
    };
    const ExitPupil::Point point = pupil_.sample(r, square);
    if (!(point.area > 0)) return dark;

    glm::dvec2 fromCentre = point.position - point.centre;
    for (int step = 0; step < kInwardSteps; ++step, fromCentre *= kInwards) {
        const glm::dvec2 pupil = turned(point.centre + fromCentre);
        const LensRay filmSide = filmRay(film, pupil);
        LensRay ray = filmSide;
        // Along pixel x, y and lens u, v.
        const double distance = (pupil_.planeZ() - filmZ_) / filmSide.direction.z;
        std::array<LensRayDerivative, 4> derivatives;
        for (int i = 0; i < 4; ++i) {
            glm::dvec3 step3(0);
            step3[i % 2] = i < 2 ? mmPerPixel_ : pupil_.radius();
            const glm::dvec3 turn =
                (step3 - filmSide.direction * glm::dot(filmSide.direction, step3)) / distance;
            derivatives[std::size_t(i)] =
                i < 2 ? LensRayDerivative{-step3, turn} : LensRayDerivative{{}, turn};
        }
        if (!lens_.traceFromFilm(ray, derivatives)) continue;
        if (ray.direction.z < kLeastForward) return dark;
        const double cosine = filmSide.direction.z, z = pupil_.planeZ() - filmZ_;
        const glm::dvec3 direction = ray.direction / ray.direction.z;
        const glm::dvec3 origin = ray.origin + (depthOrigin_ - ray.origin.z) * direction;
        const auto world = [&](glm::dvec3 v) { return right_ * v.x + down_ * v.y; };
        return {{glm::vec3(centre_ + world(origin)), glm::vec3((forward_ + world(direction)) * kMillimetres)},
                glm::vec2(pupil / pupil_.radius()),
                float(cosine * cosine * cosine * cosine * point.area / (z * z)),
                slopeOf(ray, derivatives)};
    }
    return dark;
}

/// The point seen at depth w stays where it is while the lens position moves by du: with Q = position at
/// depth 0 + w * tangents, dQ/dx dx + dQ/du du = 0. What is left out of the 2 x 2 matrix dx/du is its part
/// that is not isotropic.
SlopeModel CompoundLens::slopeOf(const LensRay& ray, std::span<const LensRayDerivative> derivatives) const {
    std::array<glm::dvec2, 4> position, tangents; // derivatives
    const glm::dvec2 tangent = glm::dvec2(ray.direction) / ray.direction.z;
    const double t = (depthOrigin_ - ray.origin.z) / ray.direction.z;
    for (std::size_t i = 0; i < 4; ++i) {
        const LensRayDerivative& d = derivatives[i];
        tangents[i] = (glm::dvec2(d.direction) - tangent * d.direction.z) / ray.direction.z;
        const glm::dvec3 moved = d.origin + t * d.direction;
        position[i] = (glm::dvec2(moved) - tangent * moved.z) / kMillimetres;
    }
    // With q = 1 / w, X = X0 + q X1 = dQ/dx / w and U likewise: the slope is -trace(X^-1 U) / 2.
    const auto det = [](glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; };
    // trace(X^-1 U) = (det(U_0, X_1) + det(X_0, U_1)) / det(X_0, X_1), by columns; each polynomial in q.
    const auto product = [&](std::size_t i, std::size_t j, std::array<double, 3>& sum, double factor) {
        sum[0] += factor * det(tangents[i], tangents[j]);
        sum[1] += factor * (det(tangents[i], position[j]) + det(position[i], tangents[j]));
        sum[2] += factor * det(position[i], position[j]);
    };
    std::array<double, 3> top{}, bottom{};
    product(2, 1, top, -0.5);
    product(0, 3, top, -0.5);
    product(0, 1, bottom, 1);
    return {float(top[1] / bottom[0]), float(top[0] / bottom[0]), float(top[2] / bottom[0]),
            float(bottom[1] / bottom[0]), float(bottom[2] / bottom[0])};
}

SlopeModel CompoundLens::slopeModel() const {
    return sample(glm::vec2(filmCentre_), {0.5f, 0.5f}).slope;
}

} // namespace slant

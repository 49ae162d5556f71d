#include "camera/lens_system.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace slant {
namespace {

constexpr double kMissed = std::numeric_limits<double>::infinity();

/// A paraxial system between two planes: height and (index times angle) of a ray that runs towards the film
/// (Hecht, Optics, section 6.2). Unit determinant.
struct Paraxial {
    double a = 1, b = 0, c = 0, d = 1;

    void addGap(double distance, double index) {
        a += distance / index * c;
        b += distance / index * d;
    }
    void addSurface(double radius, double indexBefore, double indexBehind) {
        if (radius == 0) return;
        const double power = (indexBehind - indexBefore) / radius;
        c -= power * a;
        d -= power * b;
    }
};

} // namespace

LensSystem::LensSystem(const LensPrescription& lens, double stopDiameterMm) {
    // Summed from the rear, so that the rear vertex is exactly at 0 and the distance to the film, which some
    // files give there, does not matter.
    std::vector<double> vertices(lens.surfaces.size());
    for (std::size_t i = lens.surfaces.size() - 1; i-- > 0;)
        vertices[i] = vertices[i + 1] + lens.surfaces[i].thickness;
    double indexBefore = 1;
    for (std::size_t i = 0; i < lens.surfaces.size(); ++i) {
        const LensSurface& s = lens.surfaces[i];
        const double diameter = i == lens.stop ? stopDiameterMm : s.diameter;
        surfaces_.push_back({vertices[i], s.radius, diameter * diameter / 4, s.index, indexBefore});
        indexBefore = s.index;
    }
    findCardinalPoints(lens.path);
    findPupils(lens.stop);
}

void LensSystem::findCardinalPoints(const std::string& path) {
    Paraxial system;
    for (std::size_t i = 0; i < surfaces_.size(); ++i) {
        const Surface& s = surfaces_[i];
        if (i > 0) system.addGap(surfaces_[i - 1].vertex - s.vertex, s.indexBefore);
        system.addSurface(s.radius, s.indexBefore, s.indexBehind);
    }
    if (!(system.c < -1e-9))
        throw badInput({path}, "the lens forms no image: its power is {:.4g} per metre, but must be above 0",
                       0 - 1000 * system.c);
    focalLength_ = -1 / system.c;
    rearFocus_ = system.a / system.c;
    frontFocus_ = frontVertex() - system.d / system.c;
}

void LensSystem::findPupils(std::size_t stop) {
    const double radius = std::sqrt(surfaces_[stop].clearRadius2);
    Paraxial front, rear;
    for (std::size_t i = 0; i < surfaces_.size(); ++i) {
        const Surface& s = surfaces_[i];
        Paraxial& part = i <= stop ? front : rear;
        if (i > 0) part.addGap(surfaces_[i - 1].vertex - s.vertex, s.indexBefore);
        part.addSurface(s.radius, s.indexBefore, s.indexBehind);
    }
    entrancePupil_ = {frontVertex() - front.b / front.a, radius / std::abs(front.a)};
    exitPupil_ = {rear.b / rear.d, radius / std::abs(rear.d)};
}

double LensSystem::pass(const Surface& s, double eta, LensRay& ray,
                        std::span<LensRayDerivative> derivatives) {
    const glm::dvec3 d = ray.direction;
    if (s.radius == 0) {
        const double t = (s.vertex - ray.origin.z) / d.z;
        if (!(t >= 0)) return kMissed;
        const glm::dvec3 p = ray.origin + t * d;
        return p.x * p.x + p.y * p.y; // the ray itself and its derivatives go on as they are
    }
    // Of the two crossings of the sphere, the one on the side of the vertex.
    const glm::dvec3 fromCentre = ray.origin - glm::dvec3(0, 0, s.vertex - s.radius);
    const double along = glm::dot(fromCentre, d);
    const double discriminant = along * along - (glm::dot(fromCentre, fromCentre) - s.radius * s.radius);
    if (!(discriminant >= 0)) return kMissed;
    const double root = std::sqrt(discriminant);
    const double t = (d.z > 0) == (s.radius > 0) ? root - along : -root - along;
    if (t < 0) return kMissed;
    const glm::dvec3 p = ray.origin + t * d;

    const glm::dvec3 n = (fromCentre + t * d) / s.radius;
    const double c = glm::dot(n, d);
    const double k = 1 - eta * eta * (1 - c * c);
    if (!(k > 0)) return kMissed;
    const double refracted = c > 0 ? std::sqrt(k) : -std::sqrt(k), bend = refracted - eta * c;
    // Derivatives of the steps above; the point stays on the sphere.
    for (LensRayDerivative& each : derivatives) {
        const glm::dvec3 drift = each.origin + t * each.direction;
        const glm::dvec3 dp = drift - glm::dot(n, drift) / c * d;
        const glm::dvec3 dn = dp / s.radius;
        const double dc = glm::dot(dn, d) + glm::dot(n, each.direction);
        const double dbend = eta * eta * c * dc / refracted - eta * dc;
        each = {dp, eta * each.direction + dbend * n + bend * dn};
    }
    ray = {p, eta * d + bend * n};
    return p.x * p.x + p.y * p.y;
}

bool LensSystem::traceFromFilm(LensRay& ray, std::span<LensRayDerivative> derivatives) const {
    for (auto s = surfaces_.rbegin(); s != surfaces_.rend(); ++s)
        if (!(pass(*s, s->indexBehind / s->indexBefore, ray, derivatives) <= s->clearRadius2)) return false;
    return true;
}

std::optional<double> LensSystem::traceBesideRims(LensRay& ray,
                                                  std::span<LensRayDerivative> derivatives) const {
    double clearance = 1;
    for (auto s = surfaces_.rbegin(); s != surfaces_.rend(); ++s) {
        const double height2 = pass(*s, s->indexBehind / s->indexBefore, ray, derivatives);
        if (height2 == kMissed) return std::nullopt;
        if (s->radius != 0) clearance = std::min(clearance, 1 - height2 / s->clearRadius2);
    }
    return clearance;
}

bool LensSystem::traceToStop(LensRay& ray, std::span<LensRayDerivative> derivatives) const {
    auto s = surfaces_.rbegin();
    for (; s->radius != 0; ++s)
        if (pass(*s, s->indexBehind / s->indexBefore, ray, derivatives) == kMissed) return false;
    const glm::dvec3 d = ray.direction;
    const double t = (s->vertex - ray.origin.z) / d.z;
    for (LensRayDerivative& each : derivatives) {
        const glm::dvec3 drift = each.origin + t * each.direction;
        each.origin = drift - drift.z / d.z * d;
    }
    ray.origin += t * d;
    return t >= 0;
}

bool LensSystem::traceFromScene(LensRay& ray) const {
    for (const Surface& s : surfaces_)
        if (!(pass(s, s.indexBefore / s.indexBehind, ray, {}) <= s.clearRadius2)) return false;
    return true;
}

std::vector<glm::dvec3> LensSystem::corners(LensRay ray, double front) const {
    std::vector<glm::dvec3> points{ray.origin};
    for (auto s = surfaces_.rbegin(); s != surfaces_.rend(); ++s) {
        if (!(pass(*s, s->indexBehind / s->indexBefore, ray, {}) <= s->clearRadius2)) return {};
        if (s->radius != 0) points.push_back(ray.origin);
    }
    points.push_back(ray.origin + (front - ray.origin.z) / ray.direction.z * ray.direction);
    return points;
}

double LensSystem::stopRadius() const {
    const auto stop =
        std::find_if(surfaces_.begin(), surfaces_.end(), [](const Surface& s) { return s.radius == 0; });
    return std::sqrt(stop->clearRadius2);
}

double LensSystem::rearRadius() const {
    return std::sqrt(surfaces_.back().clearRadius2);
}

std::vector<LensSystem::Outline> LensSystem::outline() const {
    std::vector<Outline> result;
    for (const Surface& s : surfaces_)
        result.push_back({s.vertex, s.radius, std::sqrt(s.clearRadius2), s.indexBehind > 1});
    return result;
}

double LensSystem::nearestFocus() const {
    return 4 * focalLength_ + frontPrincipal() - rearPrincipal();
}

double LensSystem::filmPosition(double focusDistanceMm, const FileLocation& where) const {
    const double reach = focusDistanceMm - (frontPrincipal() - rearPrincipal()); // object and image distance
    const double discriminant = reach * (reach - 4 * focalLength_);
    if (!(reach > 0 && discriminant >= 0))
        throw badInput(where, "this lens cannot focus at {:.6g} mm from the film: the nearest is {:.6g} mm",
                       focusDistanceMm, nearestFocus());
    // Of the two distances that fit, the shorter one lies on the side of the film.
    const double imageDistance = 2 * reach * focalLength_ / (reach + std::sqrt(discriminant));
    const double film = rearPrincipal() - imageDistance;
    const Surface& rear = surfaces_.back();
    const double r = rear.radius;
    const double rim = r > 0 ? std::sqrt(std::max(r * r - rear.clearRadius2, 0.0)) - r : 0;
    if (!(film < rim))
        throw badInput(where, "focused at {:.6g} mm, the film would stand {:.4g} mm within the lens",
                       focusDistanceMm, film - rim);
    if (!(film + focusDistanceMm > frontVertex()))
        throw badInput(where, "the plane in focus, {:.6g} mm from the film, would lie within the lens",
                       focusDistanceMm);
    return film;
}

double LensSystem::focusDistance(double filmDistanceMm, const FileLocation& where) const {
    const double imageDistance = rearPrincipal() - (surfaces_.back().vertex - filmDistanceMm);
    if (!(imageDistance > focalLength_))
        throw badInput(
            where, "nothing is in focus on a film {:.6g} mm behind this lens: it must be more than {:.6g} mm",
            filmDistanceMm, surfaces_.back().vertex - rearFocus());
    const double objectDistance = imageDistance * focalLength_ / (imageDistance - focalLength_);
    return objectDistance + imageDistance + frontPrincipal() - rearPrincipal();
}

} // namespace slant

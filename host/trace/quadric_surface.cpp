#include "trace/quadric_surface.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace slant {
namespace {

double angleAround(glm::dvec3 p) {
    double phi = std::atan2(p.y, p.x);
    return phi < 0 ? phi + 2 * std::numbers::pi : phi;
}

/// World bounds of an object-space box.
Box transformedBounds(const glm::dmat4& matrix, glm::dvec3 lower, glm::dvec3 upper) {
    Box box;
    for (int corner = 0; corner < 8; ++corner) {
        glm::dvec3 p(corner & 1 ? upper.x : lower.x, corner & 2 ? upper.y : lower.y,
                     corner & 4 ? upper.z : lower.z);
        box.extend(transformPoint(matrix, p));
    }
    glm::vec3 slack = 2 * gammaBound(2) * glm::max(glm::abs(box.min), glm::abs(box.max));
    return {box.min - slack, box.max + slack};
}

} // namespace

QuadricSurface::QuadricSurface(const Shape& shape)
    : kind_(shape.kind), radius_(shape.radius),
      phiMax_(std::clamp(double(shape.phiMaxDegrees), 0.0, 360.0) * std::numbers::pi / 180),
      height_(shape.height), innerRadius_(shape.innerRadius), flip_(flipsNormals(shape)) {
    const glm::dmat4& matrix = shape.worldFromObject.at[0];
    requireInvertible(matrix, shape.location);
    linear_ = glm::dmat3(matrix);
    inverseLinear_ = glm::inverse(linear_);
    normalMatrix_ = glm::transpose(inverseLinear_);
    offset_ = glm::dvec3(matrix[3]);

    if (kind_ == ShapeKind::disk) {
        bounds_ = transformedBounds(matrix, {-radius_, -radius_, height_}, {radius_, radius_, height_});
        return;
    }
    profile_ = Profile(shape);
    const double low = profile_.lowZ(), high = profile_.highZ(), r = profile_.radius;
    thetaZMin_ = std::acos(std::clamp(low / radius_, -1.0, 1.0));
    thetaZMax_ = std::acos(std::clamp(high / radius_, -1.0, 1.0));
    whole_ = shape.phiMaxDegrees >= 360 && low == -radius_ && high == radius_;
    bounds_ = transformedBounds(matrix, {-r, -r, low}, {r, r, high});
}

double QuadricSurface::phiOf(glm::dvec3 p) const {
    return kind_ == ShapeKind::hyperboloid ? profile_.phiOf(p) : angleAround(p);
}

bool QuadricSurface::insidePhi(glm::dvec3 p) const {
    return phiMax_ >= 2 * std::numbers::pi || phiOf(p) <= phiMax_;
}

std::optional<SurfaceLocation> QuadricSurface::intersect(std::uint32_t, const SurfaceRay& ray,
                                                         double tMax) const {
    SurfaceRay objectRay{inverseLinear_ * (ray.origin - offset_), inverseLinear_ * ray.direction};
    switch (kind_) {
    case ShapeKind::sphere:
        return intersectSphere(objectRay, tMax);
    case ShapeKind::disk:
        return intersectDisk(objectRay, tMax);
    default:
        return intersectTurned(objectRay, tMax);
    }
}

std::optional<SurfaceLocation> QuadricSurface::intersectSphere(const SurfaceRay& ray, double tMax) const {
    glm::dvec3 o = ray.origin, d = ray.direction;
    double a = glm::dot(d, d), b = glm::dot(o, d);
    // Computes the discriminant from the line's distance to the centre: no cancellation for distant origins.
    glm::dvec3 nearest = o - (b / a) * d;
    double discriminant = radius_ * radius_ - glm::dot(nearest, nearest);
    if (!(discriminant >= 0)) return std::nullopt;
    double q = -(b + std::copysign(std::sqrt(a * discriminant), b));
    if (q == 0) return std::nullopt;
    double c = glm::dot(o, o) - radius_ * radius_;
    double t0 = q / a, t1 = c / q;
    if (t0 > t1) std::swap(t0, t1);
    for (double t : {t0, t1}) {
        if (!(t > 0 && t < tMax)) continue;
        glm::dvec3 p = o + t * d;
        p *= radius_ / glm::length(p);
        if (whole_ || (p.z >= profile_.fromZ && p.z <= profile_.toZ && insidePhi(p)))
            return SurfaceLocation{t, p};
    }
    return std::nullopt;
}

std::optional<SurfaceLocation> QuadricSurface::intersectTurned(const SurfaceRay& ray, double tMax) const {
    const Profile& f = profile_;
    const glm::dvec3 d = ray.direction, middle(0, 0, (f.fromZ + f.toZ) / 2);
    // From the ray's point nearest to the middle of the shape: no cancellation for distant origins.
    const double shift = glm::dot(middle - ray.origin, d) / glm::dot(d, d);
    const glm::dvec3 o = ray.origin + shift * d;
    const double a = d.x * d.x + d.y * d.y - f.a * d.z * d.z;
    const double b = o.x * d.x + o.y * d.y - f.steepnessAt(o.z) * d.z;
    const double c = o.x * o.x + o.y * o.y - ((f.a * o.z + f.b) * o.z + f.c);
    const double discriminant = b * b - a * c;
    if (!(discriminant >= 0)) return std::nullopt;
    const double q = -(b + std::copysign(std::sqrt(discriminant), b));
    if (q == 0) return std::nullopt;
    double t0 = shift + q / a, t1 = shift + c / q; // one is infinite along a line of the surface
    if (t0 > t1) std::swap(t0, t1);
    for (const double t : {t0, t1}) {
        if (!(t > 0 && t < tMax)) continue;
        glm::dvec3 p = ray.origin + t * d;
        if (!(p.z >= f.lowZ() && p.z <= f.highZ())) continue;
        const double distance = std::sqrt(p.x * p.x + p.y * p.y);
        const double scale = distance > 0 ? f.radiusAt(p.z) / distance : 0;
        p.x *= scale;
        p.y *= scale;
        if (insidePhi(p)) return SurfaceLocation{t, p};
    }
    return std::nullopt;
}

std::optional<SurfaceLocation> QuadricSurface::intersectDisk(const SurfaceRay& ray, double tMax) const {
    if (ray.direction.z == 0) return std::nullopt;
    double t = (height_ - ray.origin.z) / ray.direction.z;
    if (!(t > 0 && t < tMax)) return std::nullopt;
    glm::dvec3 p = ray.origin + t * ray.direction;
    p.z = height_;
    double squaredDistance = p.x * p.x + p.y * p.y;
    if (squaredDistance > radius_ * radius_ || squaredDistance < innerRadius_ * innerRadius_ || !insidePhi(p))
        return std::nullopt;
    return SurfaceLocation{t, p};
}

SurfaceLocation QuadricSurface::locate(const FoundHit& found, const SurfaceRay& ray) const {
    // Embree rounds rays in instances to float: what it just hit may be missed here.
    return intersect(0, ray, std::numeric_limits<double>::infinity())
        .value_or(SurfaceLocation{found.t, found.local});
}

void QuadricSurface::describe(std::uint32_t, const SurfaceLocation& at, SurfaceHit& hit) const {
    glm::dvec3 p = at.local, normal, dpdv;
    const double phi = phiOf(p);
    if (kind_ == ShapeKind::sphere) {
        double theta = std::acos(std::clamp(p.z / radius_, -1.0, 1.0));
        hit.uv = {float(phi / phiMax_), float((theta - thetaZMin_) / (thetaZMax_ - thetaZMin_))};
        normal = p;
        if (p.x == 0 && p.y == 0) p.x = 1e-5 * radius_; // the pole: any direction around the axis will do
        const double distance = std::sqrt(p.x * p.x + p.y * p.y);
        dpdv = (thetaZMax_ - thetaZMin_) * glm::dvec3(p.z * p.x / distance, p.z * p.y / distance, -distance);
    } else if (kind_ == ShapeKind::disk) {
        double distance = std::sqrt(p.x * p.x + p.y * p.y);
        hit.uv = {float(phi / phiMax_), float((radius_ - distance) / (radius_ - innerRadius_))};
        normal = {0, 0, 1};
        if (distance == 0) p.x = 1e-5 * radius_;
        dpdv = (innerRadius_ - radius_) * glm::normalize(glm::dvec3(p.x, p.y, 0));
    } else {
        hit.uv = {float(phi / phiMax_), float(profile_.vAt(p.z))};
        if (p.x == 0 && p.y == 0) p.x = 1e-5 * profile_.radius; // the tip
        normal = profile_.normalAt(p);
        dpdv = profile_.dpdv(p);
    }
    normal = glm::normalize(normalMatrix_ * (flip_ ? -normal : normal));
    hit.position = linear_ * at.local + offset_;
    hit.geometricNormal = hit.shadingNormal = normal;
    hit.dpdu = linear_ * glm::dvec3(-phiMax_ * p.y, phiMax_ * p.x, 0);
    hit.dpdv = linear_ * dpdv;
    hit.positionError = gammaBound(2) * glm::abs(hit.position);
}

} // namespace slant

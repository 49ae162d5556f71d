#include "trace/profile.h"

#include <numbers>

namespace slant {
namespace {

double cross(glm::dvec2 p, glm::dvec2 q) {
    return p.x * q.y - p.y * q.x;
}

} // namespace

Profile::Profile(const Shape& shape)
    : phiMax(std::clamp(double(shape.phiMaxDegrees), 0.0, 360.0) * std::numbers::pi / 180) {
    if (shape.kind == ShapeKind::sphere) {
        radius = double(shape.radius);
        fromZ = std::clamp(double(std::min(shape.zMin, shape.zMax)), -radius, radius);
        toZ = std::clamp(double(std::max(shape.zMin, shape.zMax)), -radius, radius);
        a = -1;
        c = radius * radius;
        return;
    }
    const glm::dvec3 first(shape.ends[0]), second(shape.ends[1]);
    from = glm::dvec2(first);
    to = glm::dvec2(second);
    fromZ = first.z;
    toZ = second.z;
    radius = std::max(glm::length(from), glm::length(to));
    if (shape.kind == ShapeKind::paraboloid) {
        b = to.x * to.x / toZ;
        return;
    }
    // Along the line the square of the radius is quadratic in v, and v is linear in z.
    const glm::dvec2 perZ = (to - from) / (toZ - fromZ), atZero = from - fromZ * perZ;
    a = glm::dot(perZ, perZ);
    b = 2 * glm::dot(perZ, atZero);
    c = glm::dot(atZero, atZero);
}

double Profile::phiOf(glm::dvec3 p) const {
    const glm::dvec2 curve = curveAt(p.z), xy(p);
    const double phi = std::atan2(cross(curve, xy), glm::dot(curve, xy));
    return phi < 0 ? phi + 2 * std::numbers::pi : phi;
}

glm::dvec3 Profile::point(double z, double phi) const {
    const glm::dvec2 curve = curveAt(z);
    const double angle = phi + std::atan2(curve.y, curve.x), r = radiusAt(z);
    return {r * std::cos(angle), r * std::sin(angle), z};
}

glm::dvec3 Profile::dpdv(glm::dvec3 p) const {
    const double outwards = steepnessAt(p.z) * (toZ - fromZ), around = cross(from, to);
    const glm::dvec2 xy(p), turned(-p.y, p.x);
    return {(outwards * xy + around * turned) / glm::dot(xy, xy), toZ - fromZ};
}

} // namespace slant

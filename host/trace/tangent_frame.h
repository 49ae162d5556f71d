// Tangents for normals.
#pragma once
#include <cmath>
#include <glm/glm.hpp>

namespace slant {

/// A unit vector at right angles to a unit normal: the first of pbrt's CoordinateSystem (Duff et al.,
/// "Building an Orthonormal Basis, Revisited", 2017).
inline glm::dvec3 anyTangent(glm::dvec3 n) {
    double sign = std::copysign(1.0, n.z);
    double a = -1 / (sign + n.z);
    return {1 + sign * n.x * n.x * a, sign * n.x * n.y * a, -sign * n.x};
}

/// The part of `tangent` at right angles to a unit normal; any tangent if there is none.
inline glm::dvec3 tangentAcross(glm::dvec3 tangent, glm::dvec3 normal) {
    glm::dvec3 across = tangent - glm::dot(tangent, normal) * normal;
    return glm::dot(across, across) > 0 ? across : anyTangent(normal);
}

} // namespace slant

// Maps from the unit square to directions and points, and the frames they are given in. Every map takes
// uniform random numbers in [0, 1) and states its density.
#pragma once
#include "camera/disc.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace slant {

inline constexpr float kPi = 3.14159265358979323846f;
inline constexpr float kInvPi = 1 / kPi;

/// Right-handed orthonormal basis around a unit vector (Duff et al. 2017, "Building an Orthonormal Basis,
/// Revisited").
struct Frame {
    glm::vec3 x, y, z;

    static Frame around(glm::vec3 z) {
        float sign = std::copysign(1.f, z.z);
        float a = -1 / (sign + z.z), b = z.x * z.y * a;
        return {{1 + sign * z.x * z.x * a, sign * b, -sign * z.x}, {b, sign + z.y * z.y * a, -z.y}, z};
    }
    /// z unit; x along the part of `tangent` that is perpendicular to z, or anywhere if there is none.
    static Frame along(glm::vec3 z, glm::vec3 tangent) {
        glm::vec3 x = tangent - z * glm::dot(z, tangent);
        float length2 = glm::dot(x, x);
        if (!(length2 > 0) || !std::isfinite(length2)) return around(z);
        x /= std::sqrt(length2);
        return {x, glm::cross(z, x), z};
    }
    glm::vec3 toLocal(glm::vec3 v) const { return {glm::dot(x, v), glm::dot(y, v), glm::dot(z, v)}; }
    glm::vec3 toWorld(glm::vec3 v) const { return x * v.x + y * v.y + z * v.z; }
};

/// Around +z with density cos / pi.
inline glm::vec3 warpToCosineHemisphere(glm::vec2 u) {
    glm::vec2 d = concentricDisc(u.x, u.y);
    return {d, std::sqrt(std::max(0.f, 1 - d.x * d.x - d.y * d.y))};
}

/// Uniform on the sphere, density 1 / (4 pi).
inline glm::vec3 warpToSphere(glm::vec2 u) {
    float z = 1 - 2 * u.x, r = std::sqrt(std::max(0.f, 1 - z * z)), phi = 2 * kPi * u.y;
    return {r * std::cos(phi), r * std::sin(phi), z};
}

/// Barycentric weights of the second and third vertex, uniform over the triangle, strata kept compact (Heitz
/// 2019, "A Low-Distortion Map Between Triangle and Square").
inline glm::vec2 warpToTriangle(glm::vec2 u) {
    if (u.y > u.x) {
        u.x *= 0.5f;
        u.y -= u.x;
    } else {
        u.y *= 0.5f;
        u.x -= u.y;
    }
    return u;
}

/// Brightness of a colour for choosing samples; linear Rec.709.
inline float luminance(glm::vec3 rgb) {
    return 0.2126f * rgb.x + 0.7152f * rgb.y + 0.0722f * rgb.z;
}

/// Largest component.
inline float maxComponent(glm::vec3 v) {
    return std::max(v.x, std::max(v.y, v.z));
}

} // namespace slant

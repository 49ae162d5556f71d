// The equal-area octahedral map between directions and the unit square that pbrt-v4 uses for environment
// images (Clarberg 2008, "Fast Equal-Area Mapping of the (Hemi)Sphere using SIMD"): equal areas of the square
// are equal solid angles.
#pragma once
#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>
#include <utility>

namespace slant {

/// Unit direction of a point of [0, 1]^2.
inline glm::vec3 equalAreaSquareToSphere(glm::vec2 p) {
    glm::vec2 q = 2.f * p - 1.f, a = glm::abs(q);
    float signedDistance = 1 - (a.x + a.y);
    float r = 1 - std::abs(signedDistance);
    float phi = std::numbers::pi_v<float> / 4 * (r == 0 ? 1 : (a.y - a.x) / r + 1);
    float z = std::copysign(1 - r * r, signedDistance);
    float across = r * std::sqrt(std::max(0.f, 2 - r * r));
    return {across * std::copysign(std::cos(phi), q.x), across * std::copysign(std::sin(phi), q.y), z};
}

/// Point of [0, 1]^2 of a unit direction.
inline glm::vec2 equalAreaSphereToSquare(glm::vec3 d) {
    glm::vec3 a = glm::abs(d);
    float r = std::sqrt(std::max(0.f, 1 - a.z));
    float phi = std::atan2(a.y, a.x) * (2 / std::numbers::pi_v<float>); // 0 and 0 give 0
    float v = phi * r, u = r - v;
    if (d.z < 0) {
        std::swap(u, v);
        u = 1 - u;
        v = 1 - v;
    }
    return 0.5f + 0.5f * glm::vec2(std::copysign(u, d.x), std::copysign(v, d.y));
}

} // namespace slant

// Mapping of the unit square onto the unit disc that preserves areas and keeps neighbours together.
#pragma once
#include <cmath>
#include <glm/glm.hpp>

namespace slant {

/// Concentric map (Shirley and Chiu, "A Low Distortion Map Between Disk and Square", 1997), oriented as
/// pbrt's: [0, 1)^2 onto the disc x^2 + y^2 <= 1. The sine and cosine are polynomials for |angle| <= pi/4
/// (error below 2e-7), not libm's: these differ between processors.
inline glm::vec2 concentricDisc(float a, float b) {
    float x = 2 * a - 1, y = 2 * b - 1;
    bool wide = std::abs(x) > std::abs(y);
    float radius = wide ? x : y;
    float ratio = radius == 0 ? 0.f : (wide ? y : x) / radius;
    float angle = 0.78539816f * ratio, q = angle * angle;
    float sine = angle * (1 + q * (-1.f / 6 + q * (1.f / 120 + q * (-1.f / 5040 + q * (1.f / 362880)))));
    float cosine = 1 + q * (-0.5f + q * (1.f / 24 + q * (-1.f / 720 + q * (1.f / 40320))));
    // Rounding must not carry a point over the rim.
    radius *= 0.99999994f;
    return wide ? glm::vec2(radius * cosine, radius * sine) : glm::vec2(radius * sine, radius * cosine);
}

} // namespace slant

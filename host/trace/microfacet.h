// Fresnel reflectance and the Trowbridge-Reitz (GGX) distribution of microfacets, in a local frame whose z is
// the normal. Definitions are those of pbrt-v4 (Pharr, Jakob, Humphreys: Physically Based Rendering, 4th
// edition, chapter 9).
#pragma once
#include "trace/warp.h"

namespace slant {

/// Unpolarised reflectance of a dielectric; cosine > 0 of the direction on the incident side, eta = index on
/// the far side over that on the incident side. `cosineTransmitted` becomes 0 at total internal reflection.
inline float fresnelDielectric(float cosine, float eta, float& cosineTransmitted) {
    float sin2Transmitted = std::max(0.f, 1 - cosine * cosine) / (eta * eta);
    cosineTransmitted = 0;
    if (sin2Transmitted >= 1) return 1;
    float c = cosineTransmitted = std::sqrt(1 - sin2Transmitted);
    float parallel = (eta * cosine - c) / (eta * cosine + c);
    float perpendicular = (cosine - eta * c) / (cosine + eta * c);
    return 0.5f * (parallel * parallel + perpendicular * perpendicular);
}

/// Unpolarised reflectance of a conductor of complex index eta + i k, one channel at a time.
inline float fresnelConductor(float cosine, float eta, float k) {
    float cos2 = cosine * cosine, sin2 = 1 - cos2;
    float t0 = eta * eta - k * k - sin2;
    float a2PlusB2 = std::sqrt(t0 * t0 + 4 * eta * eta * k * k);
    float t1 = a2PlusB2 + cos2;
    float t2 = 2 * cosine * std::sqrt(std::max(0.f, 0.5f * (a2PlusB2 + t0)));
    float perpendicular = (t1 - t2) / (t1 + t2);
    float t3 = cos2 * a2PlusB2 + sin2 * sin2, t4 = t2 * sin2;
    float parallel = perpendicular * (t3 - t4) / (t3 + t4);
    return 0.5f * (perpendicular + parallel);
}

inline glm::vec3 fresnelConductor(float cosine, glm::vec3 eta, glm::vec3 k) {
    return {fresnelConductor(cosine, eta.x, k.x), fresnelConductor(cosine, eta.y, k.y),
            fresnelConductor(cosine, eta.z, k.z)};
}

/// Below this alpha a surface counts as a mirror, as in pbrt-v4.
inline constexpr float kSmoothAlpha = 1e-3f;

/// Roughness along the tangents x and y.
struct Microfacets {
    glm::vec2 alpha{0};

    bool smooth() const { return std::max(alpha.x, alpha.y) < kSmoothAlpha; }
    /// Density of normals m, per solid angle.
    float density(glm::vec3 m) const {
        float x = m.x / alpha.x, y = m.y / alpha.y, e = x * x + y * y + m.z * m.z;
        return kInvPi / (alpha.x * alpha.y * e * e);
    }
    /// Smith's Lambda; w.z != 0.
    float lambda(glm::vec3 w) const {
        float x = alpha.x * w.x, y = alpha.y * w.y;
        return 0.5f * (std::sqrt(1 + (x * x + y * y) / (w.z * w.z)) - 1);
    }
    float masking(glm::vec3 w) const { return 1 / (1 + lambda(w)); }
    float maskingShadowing(glm::vec3 wo, glm::vec3 wi) const { return 1 / (1 + lambda(wo) + lambda(wi)); }
    /// A normal seen from w (w.z > 0), with density masking(w) density(m) max(0, w.m) / w.z (Dupuy and
    /// Benyoub 2023, "Sampling Visible GGX Normals with Spherical Caps").
    glm::vec3 sampleVisible(glm::vec3 w, glm::vec2 u) const {
        glm::vec3 stretched = glm::normalize(glm::vec3(alpha.x * w.x, alpha.y * w.y, w.z));
        float phi = 2 * kPi * u.x;
        float z = (1 - u.y) * (1 + stretched.z) - stretched.z;
        float r = std::sqrt(std::max(0.f, 1 - z * z));
        glm::vec3 half = glm::vec3(r * std::cos(phi), r * std::sin(phi), z) + stretched;
        return glm::normalize(glm::vec3(alpha.x * half.x, alpha.y * half.y, std::max(half.z, 1e-6f)));
    }
};

} // namespace slant

// The expectation of pbrt-v4's coated diffuse material: a dielectric interface over a Lambertian base, with
// an absorbing gap of optical thickness `thickness` between them (pbrt attenuates each crossing of it by
// exp(-thickness / |cos|) even where the medium has no albedo).
//
// pbrt follows random walks; a walk that meets the base n times contributes R/pi times what enters, what
// leaves and n - 1 internal reflections, so that the sum is a geometric series:
//
//     f = f_interface + R / (pi eta^2) * T(wo) T(wi) * sum_{n=0}^{N-1} (R A)^n,   N = ceil(maxDepth / 2)
//
// T(w): part of the light from w that reaches the base; 1 / eta^2 from the compression of radiance; A: part
// of the light that leaves the base diffusely and is reflected back to it. For a smooth interface T is
// Fresnel's transmittance, for a rough one both are integrated over pbrt's single-scattering microfacets and
// tabulated. The series ends where pbrt's walks end (maxDepth crossings), so nothing is left out: with the
// defaults (eta 1.5, maxDepth 10) the infinite series would be brighter by 0.6 % at R = 0.6 and 8 % at R = 1.
#pragma once
#include "trace/microfacet.h"

#include <vector>

namespace slant {

class Coat {
public:
    /// eta > 0: index inside over outside; thickness >= 0; alphas in [alphaMin, alphaMax] will be asked for.
    Coat(float eta, float thickness, int maxDepth, float alphaMin, float alphaMax);

    float eta() const { return eta_; }
    /// T for a direction outside at this cosine > 0 to the normal, and roughness alpha along it (0 = smooth).
    float transmittance(float cosine, float alpha) const;
    /// R / (pi eta^2) times the series.
    glm::vec3 baseFactor(glm::vec3 reflectance, float alpha) const;
    /// Mean of T under cosine-weighted light.
    float meanTransmittance() const { return meanTransmittance_; }

private:
    struct Row {
        float internalAlbedo;
        std::vector<float> transmittance; ///< at cosines 0, 1/(n-1), ..., 1
    };
    float smoothTransmittance(float cosine) const;
    Row makeRow(float alpha) const;
    float rowPosition(float alpha) const;

    float eta_, thickness_;
    int baseBounces_;
    float alphaMin_, alphaMax_;
    std::vector<Row> rows_; ///< evenly spaced in alpha
    float meanTransmittance_ = 0;
};

} // namespace slant

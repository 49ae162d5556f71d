#include "trace/coat.h"

namespace slant {
namespace {

constexpr int kCosines = 64;    ///< columns of the table
constexpr int kAlphas = 17;     ///< rows, where roughness varies
constexpr int kNormals = 24;    ///< microfacet normals per dimension in the integrals
constexpr int kDirections = 64; ///< directions inside in the integral for the internal albedo

/// Light that crosses the gap at this cosine.
float gapTransmittance(float thickness, float cosine) {
    return thickness == 0 ? 1.f : std::exp(-thickness / cosine);
}

glm::vec3 directionAt(float cosine) {
    return {std::sqrt(std::max(0.f, 1 - cosine * cosine)), 0, cosine};
}

/// Mean over the visible normals of `integrand(normal)`.
template <typename Integrand>
float meanOverNormals(const Microfacets& facets, glm::vec3 w, const Integrand& integrand) {
    double sum = 0;
    for (int i = 0; i < kNormals; ++i)
        for (int j = 0; j < kNormals; ++j)
            sum += double(integrand(facets.sampleVisible(w, (glm::vec2(i, j) + 0.5f) / float(kNormals))));
    return float(sum / (kNormals * kNormals));
}

/// Part of the light from `w` outside that a rough interface lets through to the base.
float roughTransmittance(const Microfacets& facets, float eta, float thickness, glm::vec3 w) {
    return meanOverNormals(facets, w, [&](glm::vec3 m) {
        float cosine = glm::dot(w, m), cosineTransmitted;
        if (cosine <= 0) return 0.f;
        float through = 1 - fresnelDielectric(cosine, eta, cosineTransmitted);
        glm::vec3 inside = (cosine / eta - cosineTransmitted) * m - w / eta;
        if (through == 0 || inside.z >= 0) return 0.f;
        return through * facets.maskingShadowing(w, inside) / facets.masking(w) *
               gapTransmittance(thickness, -inside.z);
    });
}

/// Part of the light from `w` inside that a rough interface reflects back; the crossing after it included.
float roughInternalReflectance(const Microfacets& facets, float eta, float thickness, glm::vec3 w) {
    return meanOverNormals(facets, w, [&](glm::vec3 m) {
        float cosine = glm::dot(w, m), cosineTransmitted;
        if (cosine <= 0) return 0.f;
        glm::vec3 reflected = 2 * cosine * m - w;
        if (reflected.z <= 0) return 0.f;
        return fresnelDielectric(cosine, 1 / eta, cosineTransmitted) * facets.maskingShadowing(w, reflected) /
               facets.masking(w) * gapTransmittance(thickness, reflected.z);
    });
}

} // namespace

Coat::Coat(float eta, float thickness, int maxDepth, float alphaMin, float alphaMax)
    : eta_(eta), thickness_(thickness), baseBounces_((maxDepth + 1) / 2), alphaMin_(alphaMin),
      alphaMax_(alphaMax) {
    int rows = alphaMin == alphaMax ? 1 : kAlphas;
    for (int row = 0; row < rows; ++row)
        rows_.push_back(
            makeRow(rows == 1 ? alphaMin : alphaMin + (alphaMax - alphaMin) * float(row) / float(rows - 1)));
    const std::vector<float>& t = rows_[std::size_t(rows / 2)].transmittance;
    for (int i = 0; i < kCosines; ++i)
        meanTransmittance_ += 2 * float(i) / (kCosines - 1) * t[std::size_t(i)] / kCosines;
}

Coat::Row Coat::makeRow(float alpha) const {
    Row row{0, std::vector<float>(kCosines)};
    Microfacets facets{glm::vec2(alpha)};
    bool smooth = facets.smooth();
    for (int i = 0; i < kCosines; ++i) {
        float cosine = std::max(1e-4f, float(i) / (kCosines - 1));
        row.transmittance[std::size_t(i)] =
            smooth ? smoothTransmittance(cosine)
                   : roughTransmittance(facets, eta_, thickness_, directionAt(cosine));
    }
    double sum = 0;
    for (int i = 0; i < kDirections; ++i) {
        float cosine = std::sqrt((float(i) + 0.5f) / kDirections),
              unused; // equal steps of cos^2: cosine-weighted
        float reflected =
            smooth ? fresnelDielectric(cosine, 1 / eta_, unused) * gapTransmittance(thickness_, cosine)
                   : roughInternalReflectance(facets, eta_, thickness_, directionAt(cosine));
        sum += double(reflected * gapTransmittance(thickness_, cosine));
    }
    row.internalAlbedo = float(sum / kDirections);
    return row;
}

float Coat::smoothTransmittance(float cosine) const {
    float cosineTransmitted;
    float through = 1 - fresnelDielectric(cosine, eta_, cosineTransmitted);
    return through > 0 ? through * gapTransmittance(thickness_, cosineTransmitted) : 0.f;
}

float Coat::rowPosition(float alpha) const {
    if (rows_.size() == 1) return 0;
    float span = alphaMax_ - alphaMin_;
    return std::clamp((alpha - alphaMin_) / span, 0.f, 1.f) * float(rows_.size() - 1);
}

float Coat::transmittance(float cosine, float alpha) const {
    if (alpha < kSmoothAlpha) return smoothTransmittance(cosine);
    float column = std::min(cosine, 1.f) * (kCosines - 1);
    std::size_t i = std::min(std::size_t(column), std::size_t(kCosines - 2));
    auto at = [&](const Row& row) {
        return glm::mix(row.transmittance[i], row.transmittance[i + 1], column - float(i));
    };
    float position = rowPosition(alpha);
    std::size_t r = std::size_t(position);
    return r + 1 >= rows_.size() ? at(rows_.back())
                                 : glm::mix(at(rows_[r]), at(rows_[r + 1]), position - float(r));
}

glm::vec3 Coat::baseFactor(glm::vec3 reflectance, float alpha) const {
    float position = rowPosition(alpha);
    std::size_t r = std::size_t(position);
    float internal = r + 1 >= rows_.size() ? rows_.back().internalAlbedo
                                           : glm::mix(rows_[r].internalAlbedo, rows_[r + 1].internalAlbedo,
                                                      position - float(r));
    glm::vec3 step = reflectance * internal, series(0);
    for (int n = 0; n < baseBounces_; ++n) series = 1.f + step * series;
    return reflectance * series * (kInvPi / (eta_ * eta_));
}

} // namespace slant

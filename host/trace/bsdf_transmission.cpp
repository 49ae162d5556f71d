// What passes surfaces: dielectrics, smooth, rough (Walter et al. 2007) and thin, and translucent leaves.
#include "trace/bsdf.h"

namespace slant {
namespace {

/// Light is looked for on either side with at least this chance.
constexpr float kLeastSideChance = 0.1f;

} // namespace

Bsdf Bsdf::dielectric(glm::vec3 normal, glm::vec3 tangent, glm::vec3 wo, Microfacets facets, float eta) {
    Bsdf b;
    if (!b.setDirections(normal, wo)) return b;
    b.kind_ = facets.smooth() || eta == 1 ? Kind::glass : Kind::roughGlass;
    b.facets_ = facets;
    b.eta_.x = glm::dot(normal, wo) > 0 ? eta : 1 / eta;
    b.nearChance_ = b.fresnel(b.cosineOut_).x;
    if (b.kind_ == Kind::glass) return b;
    b.makeFrame(tangent);
    b.nearChance_ = std::clamp(b.nearChance_, kLeastSideChance, 1 - kLeastSideChance);
    return b;
}

Bsdf Bsdf::thinDielectric(glm::vec3 normal, glm::vec3 wo, float eta) {
    Bsdf b;
    if (!b.setDirections(normal, wo)) return b;
    b.kind_ = Kind::glass;
    b.eta_.x = eta;
    const float once = b.fresnel(b.cosineOut_).x;
    b.eta_.x = 1;
    // All reflections between its two sides: R + T R T + T R R R T + ... with T = 1 - R.
    b.nearChance_ = once < 1 ? 2 * once / (1 + once) : 1;
    return b;
}

Bsdf Bsdf::diffuseTransmission(glm::vec3 normal, glm::vec3 wo, glm::vec3 reflectance,
                               glm::vec3 transmittance) {
    Bsdf b;
    const float near = maxComponent(reflectance), far = maxComponent(transmittance);
    if (!(near + far > 0) || !b.setDirections(normal, wo)) return b;
    b.kind_ = Kind::translucent;
    b.colour_ = reflectance;
    b.transmitted_ = transmittance;
    b.nearChance_ = near / (near + far);
    return b;
}

/// Where light that leaves along wo comes from behind a facet on the side of wo; 0: it does not pass. In
/// whatever space both are.
glm::vec3 Bsdf::refracted(glm::vec3 wo, glm::vec3 facet) const {
    const float cosine = glm::dot(wo, facet);
    if (eta_.x == 1) return -wo;
    float cosineBehind;
    if (fresnelDielectric(cosine, eta_.x, cosineBehind) == 1) return glm::vec3(0);
    return (cosine / eta_.x - cosineBehind) * facet - wo / eta_.x;
}

glm::vec3 Bsdf::specularDirection(bool reflected) const {
    if (reflected) return glm::normalize(2 * cosineOut_ * normal_ - wo_);
    const glm::vec3 behind = kind_ == Kind::glass ? refracted(wo_, normal_) : glm::vec3(0);
    return behind == glm::vec3(0) ? behind : glm::normalize(behind);
}

bool Bsdf::sampleGlass(float lobe, BsdfSample& result) const {
    const bool reflected = lobe < nearChance_;
    result.direction = specularDirection(reflected);
    result.specular = true;
    result.pdf = 0;
    result.eta = reflected ? 1 : eta_.x;
    result.weight = glm::vec3(1 / (result.eta * result.eta));
    return result.direction != glm::vec3(0);
}

/// `wi` local, on either side.
glm::vec3 Bsdf::glassValue(glm::vec3 wi) const {
    if (wi.z == 0) return glm::vec3(0);
    const bool reflected = wi.z > 0;
    const float eta = reflected ? 1 : eta_.x;
    glm::vec3 m = glm::normalize(localWo_ + eta * wi);
    if (m.z < 0) m = -m;
    const float out = glm::dot(localWo_, m), in = glm::dot(wi, m);
    if (!(out > 0) || in * wi.z <= 0) return glm::vec3(0);
    const float reflectance = fresnel(out).x;
    const float common = facets_.density(m) * facets_.maskingShadowing(localWo_, wi) / cosineOut_;
    if (reflected) return glm::vec3(common * reflectance / 4);
    const float stretch = in + out / eta;
    return glm::vec3(common * (1 - reflectance) * std::abs(in) * out / (stretch * stretch * eta * eta));
}

float Bsdf::glassPdf(glm::vec3 wi) const {
    if (wi.z == 0) return 0;
    const bool reflected = wi.z > 0;
    const float eta = reflected ? 1 : eta_.x;
    glm::vec3 m = glm::normalize(localWo_ + eta * wi);
    if (m.z < 0) m = -m;
    const float out = glm::dot(localWo_, m), in = glm::dot(wi, m);
    if (!(out > 0) || in * wi.z <= 0) return 0;
    const float reflectance = fresnel(out).x;
    const float visible = masking_ * facets_.density(m) / cosineOut_; // times out
    if (reflected) return visible * reflectance / 4;
    const float stretch = in + out / eta;
    return visible * out * (1 - reflectance) * std::abs(in) / (stretch * stretch);
}

bool Bsdf::sampleRoughGlass(float lobe, glm::vec2 u, BsdfSample& result) const {
    const glm::vec3 m = facets_.sampleVisible(localWo_, u);
    const float cosine = glm::dot(localWo_, m);
    if (!(cosine > 0)) return false;
    const bool reflected = lobe < fresnel(cosine).x;
    const glm::vec3 wi = reflected ? 2 * cosine * m - localWo_ : refracted(localWo_, m);
    if (reflected ? !(wi.z > 0) : !(wi.z < 0)) return false;
    result.direction = glm::normalize(frame_.toWorld(wi));
    result.eta = reflected ? 1 : eta_.x;
    result.pdf = glassPdf(wi);
    if (!(result.pdf > 0)) return false;
    result.weight = glm::vec3(facets_.maskingShadowing(localWo_, wi) / masking_ / (result.eta * result.eta));
    return true;
}

bool Bsdf::sampleTranslucent(float lobe, glm::vec2 u, BsdfSample& result) const {
    const bool near = lobe < nearChance_;
    const float chance = near ? nearChance_ : 1 - nearChance_;
    const glm::vec3 local = warpToCosineHemisphere(u);
    result.direction = glm::normalize(Frame::around(near ? normal_ : -normal_).toWorld(local));
    result.pdf = chance * kInvPi * local.z;
    result.weight = (near ? colour_ : transmitted_) / chance;
    return local.z > 0;
}

} // namespace slant

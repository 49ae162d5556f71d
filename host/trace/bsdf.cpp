#include "trace/bsdf.h"

namespace slant {

bool Bsdf::setDirections(glm::vec3 normal, glm::vec3 wo) {
    float cosine = glm::dot(normal, wo);
    if (!(std::abs(cosine) > 0)) return false;
    normal_ = cosine > 0 ? normal : -normal;
    cosineOut_ = std::min(std::abs(cosine), 1.f);
    wo_ = wo;
    return true;
}

void Bsdf::makeFrame(glm::vec3 tangent) {
    facets_.alpha = glm::max(facets_.alpha, 1e-4f);
    bool isotropic = facets_.alpha.x == facets_.alpha.y;
    frame_ = isotropic ? Frame::around(normal_) : Frame::along(normal_, tangent);
    localWo_ = frame_.toLocal(wo_);
    localWo_.z = cosineOut_;
    masking_ = facets_.masking(localWo_);
}

Bsdf Bsdf::diffuse(glm::vec3 normal, glm::vec3 wo, glm::vec3 reflectance) {
    Bsdf b;
    if (!b.setDirections(normal, wo)) return b;
    b.kind_ = Kind::diffuse;
    b.colour_ = reflectance;
    return b;
}

Bsdf Bsdf::conductor(glm::vec3 normal, glm::vec3 tangent, glm::vec3 wo, Microfacets facets, glm::vec3 eta,
                     glm::vec3 k) {
    Bsdf b;
    if (!b.setDirections(normal, wo)) return b;
    b.kind_ = facets.smooth() ? Kind::mirror : Kind::conductor;
    b.eta_ = eta;
    b.k_ = k;
    b.facets_ = facets;
    if (b.kind_ == Kind::conductor) b.makeFrame(tangent);
    return b;
}

Bsdf Bsdf::coatedDiffuse(glm::vec3 normal, glm::vec3 tangent, glm::vec3 wo, Microfacets facets,
                         const Coat& coat, glm::vec3 reflectance) {
    Bsdf b;
    if (!b.setDirections(normal, wo)) return b;
    b.kind_ = facets.smooth() || coat.eta() == 1 ? Kind::smoothCoat : Kind::roughCoat;
    b.facets_ = facets;
    b.coat_ = &coat;
    float meanAlpha = 0, alphaOut = 0;
    if (b.kind_ == Kind::roughCoat) {
        b.makeFrame(tangent);
        meanAlpha = std::sqrt(b.facets_.alpha.x * b.facets_.alpha.y);
        alphaOut = b.alphaAlong(b.localWo_);
    }
    b.colour_ = coat.baseFactor(reflectance, meanAlpha) * coat.transmittance(b.cosineOut_, alphaOut);
    float facetPart = b.fresnel(b.cosineOut_).x;
    float basePart = kPi * coat.meanTransmittance() * maxComponent(b.colour_);
    b.facetChance_ = facetPart == 0 ? 0 : facetPart / (facetPart + basePart);
    return b;
}

float Bsdf::alphaAlong(glm::vec3 w) const {
    glm::vec2 a = facets_.alpha;
    float across = w.x * w.x + w.y * w.y;
    if (a.x == a.y) return a.x;
    if (across == 0) return std::sqrt(a.x * a.y);
    return std::sqrt((a.x * a.x * w.x * w.x + a.y * a.y * w.y * w.y) / across);
}

glm::vec3 Bsdf::fresnel(float cosine) const {
    if (kind_ == Kind::mirror || kind_ == Kind::conductor) return fresnelConductor(cosine, eta_, k_);
    float unused;
    if (kind_ == Kind::coatedMirror || kind_ == Kind::coatedMetal)
        return glm::vec3(fresnelDielectric(cosine, layers_->eta, unused));
    return glm::vec3(fresnelDielectric(cosine, hasCoat() ? coat_->eta() : eta_.x, unused));
}

glm::vec3 Bsdf::facetValue(glm::vec3 wi) const {
    glm::vec3 m = glm::normalize(localWo_ + wi);
    return fresnel(glm::dot(wi, m)) *
           (facets_.density(m) * facets_.maskingShadowing(localWo_, wi) / (4 * cosineOut_));
}

float Bsdf::facetPdf(glm::vec3 wi) const {
    return masking_ * facets_.density(glm::normalize(localWo_ + wi)) / (4 * cosineOut_);
}

glm::vec3 Bsdf::baseValue(glm::vec3 localWi) const {
    float alpha = kind_ == Kind::smoothCoat ? 0.f : alphaAlong(localWi);
    return colour_ * (coat_->transmittance(localWi.z, alpha) * localWi.z);
}

glm::vec3 Bsdf::evaluate(glm::vec3 wi) const {
    float cosine = glm::dot(normal_, wi);
    if (transmits())
        return kind_ == Kind::roughGlass
                   ? glassValue(frame_.toLocal(wi))
                   : (cosine > 0 ? colour_ : transmitted_) * (kInvPi * std::abs(cosine));
    if (!(cosine > 0)) return glm::vec3(0);
    switch (kind_) {
    case Kind::diffuse:
        return colour_ * (kInvPi * cosine);
    case Kind::smoothCoat:
        return baseValue({0, 0, cosine});
    case Kind::conductor:
    case Kind::roughCoat: {
        glm::vec3 local = frame_.toLocal(wi);
        if (!(local.z > 0)) return glm::vec3(0);
        return kind_ == Kind::conductor ? facetValue(local) : facetValue(local) + baseValue(local);
    }
    case Kind::coatedMetal:
        return metalValue(frame_.toLocal(wi));
    default:
        return glm::vec3(0);
    }
}

glm::vec3 Bsdf::evaluateDiffuse(glm::vec3 wi) const {
    if (kind_ == Kind::conductor || kind_ == Kind::coatedMetal || kind_ == Kind::roughGlass)
        return glm::vec3(0);
    if (kind_ != Kind::roughCoat) return evaluate(wi);
    glm::vec3 local = frame_.toLocal(wi);
    return local.z > 0 ? baseValue(local) : glm::vec3(0);
}

float Bsdf::pdf(glm::vec3 wi) const {
    float cosine = glm::dot(normal_, wi);
    if (kind_ == Kind::roughGlass) return glassPdf(frame_.toLocal(wi));
    if (kind_ == Kind::translucent)
        return (cosine > 0 ? nearChance_ : 1 - nearChance_) * (kInvPi * std::abs(cosine));
    if (!(cosine > 0)) return 0;
    switch (kind_) {
    case Kind::diffuse:
        return kInvPi * cosine;
    case Kind::smoothCoat:
        return (1 - facetChance_) * kInvPi * cosine;
    case Kind::conductor:
        return facetPdf(frame_.toLocal(wi));
    case Kind::roughCoat:
        return facetChance_ * facetPdf(frame_.toLocal(wi)) + (1 - facetChance_) * kInvPi * cosine;
    case Kind::coatedMetal:
        return metalPdf(frame_.toLocal(wi));
    default:
        return 0;
    }
}

bool Bsdf::sample(float lobe, glm::vec2 u, BsdfSample& result) const {
    result.specular = false;
    result.eta = 1;
    switch (kind_) {
    case Kind::black:
        return false;
    case Kind::mirror:
    case Kind::coatedMirror:
        return sampleMirror(result);
    case Kind::coatedMetal:
        return sampleCoatedMetal(lobe, u, result);
    case Kind::diffuse:
        return sampleBase(u, result);
    case Kind::smoothCoat:
        return lobe < facetChance_ ? sampleMirror(result) : sampleBase(u, result);
    case Kind::conductor:
        return sampleFacets(u, result);
    case Kind::roughCoat:
        return lobe < facetChance_ ? sampleFacets(u, result) : sampleBase(u, result);
    case Kind::glass:
        return sampleGlass(lobe, result);
    case Kind::roughGlass:
        return sampleRoughGlass(lobe, u, result);
    case Kind::translucent:
        return sampleTranslucent(lobe, u, result);
    }
    return false;
}

bool Bsdf::sampleMirror(BsdfSample& result) const {
    result.direction = glm::normalize(2 * cosineOut_ * normal_ - wo_);
    result.specular = true;
    result.pdf = 0;
    result.weight = kind_ == Kind::coatedMirror
                        ? colour_
                        : fresnel(cosineOut_) / (kind_ == Kind::smoothCoat ? facetChance_ : 1.f);
    return true;
}

bool Bsdf::sampleFacets(glm::vec2 u, BsdfSample& result) const {
    glm::vec3 m = facets_.sampleVisible(localWo_, u);
    float cosine = glm::dot(localWo_, m);
    glm::vec3 wi = 2 * cosine * m - localWo_;
    if (!(wi.z > 0) || !(cosine > 0)) return false;
    result.direction = glm::normalize(frame_.toWorld(wi));
    if (kind_ == Kind::conductor) {
        result.pdf = masking_ * facets_.density(m) / (4 * cosineOut_);
        result.weight = fresnel(cosine) * (facets_.maskingShadowing(localWo_, wi) / masking_);
    } else {
        result.pdf = pdf(result.direction);
        result.weight = evaluate(result.direction) / result.pdf;
    }
    return result.pdf > 0;
}

bool Bsdf::sampleBase(glm::vec2 u, BsdfSample& result) const {
    glm::vec3 local = warpToCosineHemisphere(u);
    result.direction = glm::normalize(Frame::around(normal_).toWorld(local));
    if (kind_ == Kind::diffuse) {
        result.pdf = kInvPi * local.z;
        result.weight = colour_;
        return local.z > 0;
    }
    result.pdf = pdf(result.direction);
    if (!(result.pdf > 0)) return false;
    result.weight = evaluate(result.direction) / result.pdf;
    return true;
}

glm::vec3 Bsdf::albedo() const {
    switch (kind_) {
    case Kind::black:
        return glm::vec3(0);
    case Kind::diffuse:
        return colour_;
    case Kind::mirror:
    case Kind::conductor:
        return glm::min(fresnel(cosineOut_), 1.f);
    case Kind::smoothCoat:
    case Kind::roughCoat:
        return glm::min(fresnel(cosineOut_) + reflectance(), 1.f);
    case Kind::coatedMirror:
    case Kind::coatedMetal:
        return glm::min(colour_, 1.f);
    case Kind::glass:
    case Kind::roughGlass:
        return glm::vec3(1);
    case Kind::translucent:
        return glm::min(reflectance(), 1.f);
    }
    return glm::vec3(0);
}

glm::vec3 Bsdf::reflectance() const {
    if (kind_ == Kind::diffuse) return colour_;
    if (kind_ == Kind::translucent) return colour_ + transmitted_;
    return hasCoat() ? colour_ * (kPi * coat_->meanTransmittance()) : glm::vec3(0);
}

} // namespace slant

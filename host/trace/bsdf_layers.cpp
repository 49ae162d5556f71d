// Metals under a coat. Where both are smooth all light leaves in the mirror direction, and reflections
// between the two are a geometric series. Else a value is estimated by one random walk (Guo, Hasan and Zhao
// 2018; Pharr, Jakob, Humphreys: Physically Based Rendering, 4th edition, section 14.3): from wo down to the
// metal and up again, connected at each vertex to a direction that wi sends down through the coat. Its
// numbers are made of the directions, so that a value is always the same.
#include "trace/bsdf.h"
#include "trace/pattern.h"

namespace slant {
namespace {

constexpr glm::vec3 kUp(0, 0, 1), kAlong(1, 0, 0);
/// Part of the density, for the combination of strategies, that is spread over all directions: the rest is
/// that of a walk without bends by facets.
constexpr float kUniformPart = 0.1f;

class HashedNumbers {
public:
    explicit HashedNumbers(std::uint32_t seed) : seed_(seed) {}
    float next1D() { return unitFloat(hashWords(seed_, ++count_)); }
    glm::vec2 next2D() {
        const float x = next1D();
        return {x, next1D()};
    }

private:
    std::uint32_t seed_, count_ = 0;
};

float square(float x) {
    return x * x;
}

/// Weight of a sample of the first of two strategies.
float combined(float pdf, float otherPdf) {
    return square(pdf) / (square(pdf) + square(otherPdf));
}

/// From outside to inside through a smooth interface; 0 if nothing passes.
glm::vec3 bentDown(glm::vec3 w, float eta) {
    float cosine;
    if (fresnelDielectric(w.z, eta, cosine) == 1) return glm::vec3(0);
    return {-w.x / eta, -w.y / eta, -cosine};
}

} // namespace

Bsdf Bsdf::coatedConductor(glm::vec3 normal, glm::vec3 tangent, glm::vec3 wo, Microfacets facets,
                           const Layers& layers, Microfacets base, glm::vec3 eta, glm::vec3 k) {
    Bsdf b;
    if (!b.setDirections(normal, wo)) return b;
    const bool smoothCoat = facets.smooth() || layers.eta == 1;
    b.kind_ = smoothCoat && base.smooth() ? Kind::coatedMirror : Kind::coatedMetal;
    b.layers_ = &layers;
    b.facets_ = smoothCoat ? Microfacets() : facets;
    b.base_ = base;
    b.eta_ = eta;
    b.k_ = k;
    b.colour_ = b.coatedReflectance();
    if (b.kind_ == Kind::coatedMirror) return b;
    b.frame_ = Frame::along(b.normal_, tangent);
    b.localWo_ = b.frame_.toLocal(wo);
    b.localWo_.z = b.cosineOut_;
    return b;
}

/// Of smooth layers.
glm::vec3 Bsdf::coatedReflectance() const {
    float cosineInside;
    const float outer = fresnelDielectric(cosineOut_, layers_->eta, cosineInside);
    if (outer == 1) return glm::vec3(1);
    const float gap = layers_->thickness == 0 ? 1 : std::exp(-layers_->thickness / cosineInside);
    const glm::vec3 once = gap * gap * fresnelConductor(cosineInside, eta_, k_);
    glm::vec3 series(0);
    for (int n = 0; n < layers_->maxDepth / 2; ++n) series = 1.f + outer * once * series;
    return outer + square(1 - outer) * once * series;
}

glm::vec3 Bsdf::metalValue(glm::vec3 wi) const {
    if (!(wi.z > 0)) return glm::vec3(0);
    const bool smoothCoat = facets_.smooth();
    const auto coat = [&](glm::vec3 w) { return dielectric(kUp, kAlong, w, facets_, layers_->eta); };
    const auto gap = [&](glm::vec3 w) { return std::exp(-layers_->thickness / std::abs(w.z)); };
    HashedNumbers numbers(hashWords(hashVector(localWo_), hashVector(wi)));
    const auto sample = [&](const Bsdf& bsdf, BsdfSample& s) {
        const float lobe = numbers.next1D();
        return bsdf.sample(lobe, numbers.next2D(), s);
    };
    const Bsdf fromWo = coat(localWo_);
    glm::vec3 value = fromWo.evaluate(wi); // 0 from a smooth coat
    BsdfSample in, out;
    if (!sample(fromWo, in) || in.direction.z >= 0) return value;
    const Bsdf fromWi = coat(wi);
    if (!sample(fromWi, out) || out.direction.z >= 0) return value;
    // Importance goes that way, not radiance.
    const glm::vec3 connection =
        out.weight * square(out.eta) * gap(out.direction) * (wi.z / std::abs(out.direction.z));
    glm::vec3 w = in.direction, beta = in.weight;
    for (int depth = 0; depth < layers_->maxDepth; depth += 2) {
        beta *= gap(w);
        const Bsdf metal = conductor(kUp, kAlong, -w, base_, eta_, k_);
        if (!base_.smooth()) {
            const float weight = smoothCoat ? 1 : combined(out.pdf, metal.pdf(-out.direction));
            value += beta * metal.evaluate(-out.direction) * connection * weight;
        }
        BsdfSample up;
        if (!sample(metal, up)) break;
        w = up.direction;
        beta *= up.weight * gap(w);
        const Bsdf below = coat(-w);
        if (!smoothCoat) {
            const float weight = base_.smooth() ? 1 : combined(up.pdf, fromWi.pdf(-w));
            value += beta * below.evaluate(wi) * weight;
        }
        BsdfSample down;
        if (!sample(below, down) || down.direction.z >= 0) break;
        w = down.direction;
        beta *= down.weight;
    }
    return value;
}

float Bsdf::metalPdf(glm::vec3 wi) const {
    if (!(wi.z > 0)) return 0;
    const float reflected = fresnel(cosineOut_).x;
    const glm::vec3 wo = -bentDown(localWo_, layers_->eta), in = -bentDown(wi, layers_->eta);
    float walked = 0;
    const Microfacets& rougher = base_.smooth() ? facets_ : base_;
    if (wo.z > 0 && in.z > 0)
        walked = conductor(kUp, kAlong, wo, rougher, eta_, k_).pdf(in) * wi.z / (square(layers_->eta) * in.z);
    const float onCoat = facets_.smooth() ? 0 : conductor(kUp, kAlong, localWo_, facets_, eta_, k_).pdf(wi);
    return kUniformPart / (2 * kPi) + (1 - kUniformPart) * (reflected * onCoat + (1 - reflected) * walked);
}

bool Bsdf::sampleCoatedMetal(float lobe, glm::vec2 u, BsdfSample& result) const {
    const auto coat = [&](glm::vec3 w) { return dielectric(kUp, kAlong, w, facets_, layers_->eta); };
    const auto gap = [&](glm::vec3 w) { return std::exp(-layers_->thickness / std::abs(w.z)); };
    if (!coat(localWo_).sample(lobe, u, result)) return false;
    HashedNumbers numbers(hashWords(hashVector(localWo_), hashVector({lobe, u})));
    glm::vec3 weight = result.weight;
    for (int depth = 0; result.direction.z < 0; depth += 2) {
        if (depth + 1 >= layers_->maxDepth) return false;
        weight *= gap(result.direction);
        BsdfSample up;
        const glm::vec2 onMetal = numbers.next2D();
        if (!conductor(kUp, kAlong, -result.direction, base_, eta_, k_).sample(0, onMetal, up)) return false;
        weight *= up.weight * gap(up.direction);
        const float next = numbers.next1D();
        if (!coat(-up.direction).sample(next, numbers.next2D(), result)) return false;
        weight *= result.weight;
        result.specular = false;
    }
    result.eta = 1;
    result.weight = weight;
    result.pdf = result.specular ? 0 : metalPdf(result.direction);
    result.direction = glm::normalize(frame_.toWorld(result.direction));
    return true;
}

} // namespace slant

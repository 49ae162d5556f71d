// How a point on a surface scatters light: one plain struct with a switch over kinds, made for one outgoing
// direction, so that what depends on that direction alone is computed once.
//
// As in pbrt-v4, the shading frame alone decides which side a direction is on; all kinds but dielectrics do
// the same on both sides. Values are densities over solid angle times |cos| of the incident direction to the
// shading normal. What passes a dielectric is radiance, which grows with the square of the index.
#pragma once
#include "trace/coat.h"
#include "trace/layers.h"
#include "trace/microfacet.h"

namespace slant {

struct BsdfSample {
    glm::vec3 direction{0, 0, 1}; ///< unit, world space
    glm::vec3 weight{0};          ///< value * cos / density
    float pdf = 0;                ///< density over solid angle; meaningless if specular
    bool specular = false;        ///< a mirror direction: no other strategy can find it
    float eta = 1;                ///< index where the direction goes over that where wo is
};

class Bsdf {
public:
    enum class Kind {
        black,
        diffuse,
        mirror,
        conductor,
        smoothCoat,
        roughCoat,
        coatedMirror,
        coatedMetal, ///< not both of coat and metal are smooth
        glass,       ///< smooth
        roughGlass,
        translucent ///< diffuse, on both sides
    };

    /// Absorbs everything.
    Bsdf() = default;
    /// `normal`: unit shading normal on either side; wo: unit, from the surface to where the path came from.
    static Bsdf diffuse(glm::vec3 normal, glm::vec3 wo, glm::vec3 reflectance);
    /// Mirror where `facets` is smooth. `tangent` gives the direction of facets.alpha.x.
    static Bsdf conductor(glm::vec3 normal, glm::vec3 tangent, glm::vec3 wo, Microfacets facets,
                          glm::vec3 eta, glm::vec3 k);
    /// `coat` must outlive the result.
    static Bsdf coatedDiffuse(glm::vec3 normal, glm::vec3 tangent, glm::vec3 wo, Microfacets facets,
                              const Coat& coat, glm::vec3 reflectance);

    /// A metal under a coat; eta and k are those of the metal over the coat's index. `facets` and `layers`
    /// are of the coat, and `layers` must outlive the result. Values are estimates by a random walk between
    /// the two whose numbers depend on the directions alone.
    static Bsdf coatedConductor(glm::vec3 normal, glm::vec3 tangent, glm::vec3 wo, Microfacets facets,
                                const Layers& layers, Microfacets base, glm::vec3 eta, glm::vec3 k);
    /// `eta`: index on the far side of `normal` over that on its side.
    static Bsdf dielectric(glm::vec3 normal, glm::vec3 tangent, glm::vec3 wo, Microfacets facets, float eta);
    /// A pane: light passes straight on.
    static Bsdf thinDielectric(glm::vec3 normal, glm::vec3 wo, float eta);
    static Bsdf diffuseTransmission(glm::vec3 normal, glm::vec3 wo, glm::vec3 reflectance,
                                    glm::vec3 transmittance);

    Kind kind() const { return kind_; }
    /// Shading normal on the side of wo; 0 for a black one.
    glm::vec3 normal() const { return normal_; }
    /// Some directions scatter by other than a mirror: sampling lights makes sense.
    bool scatters() const { return kind_ != Kind::black && !specular(); }
    /// All light leaves by mirror directions or refracted ones.
    bool specular() const {
        return kind_ == Kind::mirror || kind_ == Kind::coatedMirror || kind_ == Kind::glass;
    }
    /// If so: more than half by the mirror direction.
    bool mostlyReflects() const { return kind_ != Kind::glass || nearChance_ > 0.5f; }
    /// Light from the side that wo is not on matters to evaluate(), too.
    bool transmits() const { return kind_ == Kind::roughGlass || kind_ == Kind::translucent; }
    /// If it transmits: a sensible chance to look for light on the side of wo.
    float nearChance() const { return nearChance_; }
    /// sample() uses its `lobe`.
    bool hasTwoLobes() const {
        return hasCoat() || kind_ == Kind::glass || kind_ == Kind::coatedMetal || transmits();
    }
    /// Some light leaves in a mirror direction.
    bool hasMirror() const {
        return kind_ == Kind::smoothCoat || specular() || (kind_ == Kind::coatedMetal && facets_.smooth());
    }
    /// A peaked lobe: sampling lights alone would be noisy, so strategies must be combined.
    bool glossy() const {
        return kind_ == Kind::conductor || kind_ == Kind::roughCoat || kind_ == Kind::coatedMetal ||
               kind_ == Kind::roughGlass;
    }

    /// Value * cos for light from wi (unit, world space), without mirror lobes.
    glm::vec3 evaluate(glm::vec3 wi) const;
    /// The part of that which a diffuse base reflects, rather than an interface or a metal.
    glm::vec3 evaluateDiffuse(glm::vec3 wi) const;
    /// Density with which sample() returns wi, mirror lobes aside.
    float pdf(glm::vec3 wi) const;
    /// False if the light is absorbed. `lobe` and `u` uniform in [0, 1).
    bool sample(float lobe, glm::vec2 u, BsdfSample& result) const;
    /// If it is specular: where light that comes along the returned direction leaves along wo, reflected or
    /// not; 0 if nowhere.
    glm::vec3 specularDirection(bool reflected) const;
    /// Estimate of the reflected part of uniform light, for denoisers; in [0, 1].
    glm::vec3 albedo() const;
    /// The part of that which evaluateDiffuse reflects: of an illumination by this, textures are gone.
    glm::vec3 reflectance() const;

private:
    bool hasCoat() const { return kind_ == Kind::smoothCoat || kind_ == Kind::roughCoat; }
    bool setDirections(glm::vec3 normal, glm::vec3 wo);
    glm::vec3 refracted(glm::vec3 wo, glm::vec3 facet) const;
    glm::vec3 glassValue(glm::vec3 wi) const;
    float glassPdf(glm::vec3 wi) const;
    bool sampleGlass(float lobe, BsdfSample& result) const;
    bool sampleRoughGlass(float lobe, glm::vec2 u, BsdfSample& result) const;
    glm::vec3 coatedReflectance() const;
    glm::vec3 metalValue(glm::vec3 wi) const;
    float metalPdf(glm::vec3 wi) const;
    bool sampleCoatedMetal(float lobe, glm::vec2 u, BsdfSample& result) const;
    bool sampleTranslucent(float lobe, glm::vec2 u, BsdfSample& result) const;
    void makeFrame(glm::vec3 tangent);
    glm::vec3 fresnel(float cosine) const;
    glm::vec3 facetValue(glm::vec3 wi) const;
    float facetPdf(glm::vec3 wi) const;
    glm::vec3 baseValue(glm::vec3 localWi) const;
    float alphaAlong(glm::vec3 w) const;
    bool sampleMirror(BsdfSample& result) const;
    bool sampleFacets(glm::vec2 u, BsdfSample& result) const;
    bool sampleBase(glm::vec2 u, BsdfSample& result) const;

    Kind kind_ = Kind::black;
    glm::vec3 normal_{0}, wo_{0};
    float cosineOut_ = 0;
    glm::vec3 colour_{0}; ///< diffuse: reflectance; coats: base factor times T(wo)
    // The rest is set only for the kinds that read it.
    glm::vec3 eta_, k_;     ///< dielectrics: eta_.x, as seen from the side of wo; thin ones: 1
    glm::vec3 transmitted_; ///< translucent: transmittance
    float nearChance_;      ///< dielectrics: reflected part, if the surface were smooth
    Microfacets facets_;
    Frame frame_;
    glm::vec3 localWo_;
    float masking_;     ///< lambda of wo
    float facetChance_; ///< coats: chance of sampling the interface
    const Coat* coat_;
    const Layers* layers_;
    Microfacets base_;
};

} // namespace slant

// The materials of a scene, ready to make a Bsdf at a hit.
#pragma once
#include "trace/bsdf.h"
#include "trace/interaction.h"
#include "trace/textures.h"

#include <array>
#include <memory>

namespace slant {

/// The normal and tangents that a material scatters by.
struct ShadingFrame {
    glm::vec3 normal, tangent;
};

/// Keeps pointers into the scene, which must live longer. Const calls may come from any thread.
class Materials {
public:
    /// Throws Error(badInput) for parameters outside the subset: a coated diffuse material with a scattering
    /// medium or with a textured thickness, or a missing texture.
    explicit Materials(const Scene& scene);

    /// wo: unit, from the hit to where the path came from.
    Bsdf bsdf(const SurfaceHit& hit, glm::vec3 wo) const;
    /// Whether the result may be Bsdf::specular().
    bool mayBeSpecular(const SurfaceHit& hit) const {
        return entries_[std::size_t(hit.materialIndex)].mayBeSpecular;
    }

private:
    /// A material parameter; texture -1 = the same value everywhere.
    struct Parameter {
        int texture = -1;
        TextureUse use = TextureUse::number;
        glm::vec3 value{0};
    };
    struct Entry {
        MaterialKind kind;
        bool remapRoughness, mayBeSpecular;
        bool reflectanceConductor; ///< conductor given by its reflectance at normal incidence
        Parameter reflectance, transmittance, uRoughness, vRoughness, eta, k;
        float interfaceEta, scale;
        std::array<int, 2> mixed;
        Parameter amount;
        const Image* normalMap;
        Parameter displacement;
        Parameter baseURoughness, baseVRoughness;
        std::unique_ptr<Coat> coat;
        Layers layers;

        bool hasBumps() const { return normalMap || displacement.texture >= 0; }
    };
    Parameter parameter(int texture, TextureUse use, const char* name, std::size_t material) const;
    float thickness(const Material& material, std::size_t index) const;
    std::unique_ptr<Coat> makeCoat(const Material& material, const Entry& entry, std::size_t index) const;
    glm::vec3 value(const Parameter& p, const TexturePoint& point) const {
        return p.texture < 0 ? p.value : textures_.evaluate(p.texture, point, p.use);
    }
    Microfacets facets(const Entry& entry, const TexturePoint& point) const {
        return facets(entry.uRoughness, entry.vRoughness, entry.remapRoughness, point);
    }
    Microfacets facets(const Parameter& u, const Parameter& v, bool remap, const TexturePoint& point) const;
    std::pair<glm::vec3, glm::vec3> metal(const Entry& entry, const TexturePoint& point) const;
    Entry makeEntry(const Scene& scene, std::size_t index) const;
    const Entry& chosen(const SurfaceHit& hit, glm::vec3 wo) const;
    ShadingFrame bumped(const Entry& entry, const SurfaceHit& hit) const;

    FileLocation file_;
    Textures textures_;
    std::vector<Entry> entries_;
};

} // namespace slant

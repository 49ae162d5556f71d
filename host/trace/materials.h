// The materials of a scene, ready to make a Bsdf at a hit.
#pragma once
#include "trace/bsdf.h"
#include "trace/interaction.h"
#include "trace/textures.h"

#include <memory>

namespace slant {

/// Keeps pointers into the scene, which must live longer. Const calls may come from any thread.
class Materials {
public:
    /// Throws Error(badInput) for parameters outside the subset: a coated diffuse material with a scattering
    /// medium or with a textured thickness, or a missing texture.
    explicit Materials(const Scene& scene);

    /// wo: unit, from the hit to where the path came from.
    Bsdf bsdf(const SurfaceHit& hit, glm::vec3 wo) const;

private:
    /// A material parameter; texture -1 = the same value everywhere.
    struct Parameter {
        int texture = -1;
        TextureUse use = TextureUse::number;
        glm::vec3 value{0};
    };
    struct Entry {
        MaterialKind kind;
        bool remapRoughness;
        bool reflectanceConductor; ///< conductor given by its reflectance at normal incidence
        Parameter reflectance, uRoughness, vRoughness, eta, k;
        std::unique_ptr<Coat> coat;
    };
    Parameter parameter(int texture, TextureUse use, const char* name, std::size_t material) const;
    std::unique_ptr<Coat> makeCoat(const Material& material, const Entry& entry, std::size_t index) const;
    glm::vec3 value(const Parameter& p, const TexturePoint& point) const {
        return p.texture < 0 ? p.value : textures_.evaluate(p.texture, point, p.use);
    }
    Microfacets facets(const Entry& entry, const TexturePoint& point) const;

    FileLocation file_;
    Textures textures_;
    std::vector<Entry> entries_;
};

} // namespace slant

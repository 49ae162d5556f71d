#include "trace/materials.h"

#include "base/error.h"

namespace slant {
namespace {

/// pbrt-v4's RoughnessToAlpha.
float alphaOf(float roughness, bool remap) {
    return remap ? std::sqrt(std::max(0.f, roughness)) : roughness;
}

} // namespace

Materials::Materials(const Scene& scene) : file_{scene.path, 0, 0}, textures_(scene) {
    entries_.reserve(scene.materials.size());
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        const Material& m = scene.materials[i];
        Entry e{m.kind,
                m.remapRoughness,
                m.kind == MaterialKind::conductor && m.reflectance >= 0,
                {},
                {},
                {},
                {},
                {},
                {}};
        if (m.kind != MaterialKind::conductor || e.reflectanceConductor)
            e.reflectance = parameter(m.reflectance, TextureUse::albedo, "reflectance", i);
        if (m.kind != MaterialKind::diffuse) {
            e.uRoughness = parameter(m.uRoughness, TextureUse::number, "uroughness", i);
            e.vRoughness = parameter(m.vRoughness, TextureUse::number, "vroughness", i);
        }
        if (m.kind == MaterialKind::conductor && !e.reflectanceConductor) {
            e.eta = parameter(m.eta, TextureUse::unbounded, "eta", i);
            e.k = parameter(m.k, TextureUse::unbounded, "k", i);
        }
        if (m.kind == MaterialKind::coatedDiffuse) e.coat = makeCoat(m, e, i);
        entries_.push_back(std::move(e));
    }
}

Materials::Parameter Materials::parameter(int texture, TextureUse use, const char* name,
                                          std::size_t material) const {
    if (!textures_.contains(texture))
        throw badInput(file_, "material {} has no texture for \"{}\"", material, name);
    if (!textures_.isConstant(texture)) return {texture, use, glm::vec3(0)};
    return {-1, use, textures_.evaluate(texture, TexturePoint{}, use)};
}

std::unique_ptr<Coat> Materials::makeCoat(const Material& material, const Entry& entry,
                                          std::size_t index) const {
    if (material.albedo >= 0) {
        Parameter albedo = parameter(material.albedo, TextureUse::albedo, "albedo", index);
        if (albedo.texture >= 0 || maxComponent(albedo.value) > 0)
            throw badInput(
                file_,
                "material {}: a scattering medium (\"albedo\" above 0) in coateddiffuse is outside "
                "the supported subset",
                index);
    }
    Parameter thickness = parameter(material.thickness, TextureUse::number, "thickness", index);
    if (thickness.texture >= 0)
        throw badInput(
            file_, "material {}: a textured \"thickness\" of coateddiffuse is outside the supported subset",
            index);
    float eta = material.interfaceEta == 0 ? 1.f : material.interfaceEta; // pbrt reads 0 as "no interface"
    if (!(eta > 0)) throw badInput(file_, "material {}: \"eta\" of coateddiffuse must be positive", index);
    float alphaMin = 0, alphaMax = 1;
    if (entry.uRoughness.texture < 0 && entry.vRoughness.texture < 0) {
        float u = alphaOf(entry.uRoughness.value.x, entry.remapRoughness);
        float v = alphaOf(entry.vRoughness.value.x, entry.remapRoughness);
        alphaMin = std::min(u, v);
        alphaMax = std::max(u, v);
    }
    return std::make_unique<Coat>(eta, std::max(thickness.value.x, 0.f), material.maxDepth, alphaMin,
                                  alphaMax);
}

Microfacets Materials::facets(const Entry& entry, const TexturePoint& point) const {
    return {{alphaOf(value(entry.uRoughness, point).x, entry.remapRoughness),
             alphaOf(value(entry.vRoughness, point).x, entry.remapRoughness)}};
}

Bsdf Materials::bsdf(const SurfaceHit& hit, glm::vec3 wo) const {
    const Entry& e = entries_[std::size_t(hit.materialIndex)];
    const TexturePoint point{hit.position, hit.uv, hit.geometricNormal};
    if (e.kind == MaterialKind::conductor) {
        if (!e.reflectanceConductor)
            return Bsdf::conductor(hit.shadingNormal, hit.dpdu, wo, facets(e, point), value(e.eta, point),
                                   value(e.k, point));
        glm::vec3 r = glm::clamp(value(e.reflectance, point), 0.f, 0.9999f);
        return Bsdf::conductor(hit.shadingNormal, hit.dpdu, wo, facets(e, point), glm::vec3(1),
                               2.f * glm::sqrt(r) / glm::sqrt(1.f - r));
    }
    glm::vec3 reflectance = glm::clamp(value(e.reflectance, point), 0.f, 1.f);
    if (e.kind == MaterialKind::diffuse) return Bsdf::diffuse(hit.shadingNormal, wo, reflectance);
    return Bsdf::coatedDiffuse(hit.shadingNormal, hit.dpdu, wo, facets(e, point), *e.coat, reflectance);
}

} // namespace slant

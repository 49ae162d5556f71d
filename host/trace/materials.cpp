#include "trace/materials.h"

#include "base/error.h"
#include "trace/pattern.h"

#include <cmath>

namespace slant {
namespace {

/// pbrt-v4's RoughnessToAlpha.
float alphaOf(float roughness, bool remap) {
    return remap ? std::sqrt(std::max(0.f, roughness)) : roughness;
}

/// Steps of u and v over which bumps are looked at; pbrt's, where it knows no size of a pixel.
constexpr float kBumpStep = 0.0005f;

/// Repeats beyond the unit square, in which the first row of the image lies at the top.
glm::vec3 bilinear(const Image& image, glm::vec2 st) {
    const int width = image.width(), height = image.height();
    const glm::vec2 p = (st - glm::floor(st)) * glm::vec2(width, height) - 0.5f;
    const glm::vec2 corner = glm::floor(p), f = p - corner;
    const auto texel = [&](int dx, int dy) {
        const int x = (int(corner.x) + dx + width) % width, y = (int(corner.y) + dy + height) % height;
        return glm::vec3(image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2));
    };
    return glm::mix(glm::mix(texel(0, 0), texel(1, 0), f.x), glm::mix(texel(0, 1), texel(1, 1), f.x), f.y);
}

} // namespace

Materials::Materials(const Scene& scene) : file_{scene.path, 0, 0}, textures_(scene) {
    entries_.reserve(scene.materials.size());
    for (std::size_t i = 0; i < scene.materials.size(); ++i) entries_.push_back(makeEntry(scene, i));
}

Materials::Entry Materials::makeEntry(const Scene& scene, std::size_t index) const {
    const Material& m = scene.materials[index];
    Entry e{};
    e.kind = m.kind;
    e.remapRoughness = m.remapRoughness;
    e.interfaceEta = m.interfaceEta;
    e.scale = m.scale;
    e.mixed = m.mixed;
    const auto number = [&](int texture, const char* name) {
        return parameter(texture, TextureUse::number, name, index);
    };
    const auto colour = [&](int texture, const char* name, TextureUse use = TextureUse::albedo) {
        return parameter(texture, use, name, index);
    };
    const auto readRoughness = [&] {
        e.uRoughness = number(m.uRoughness, "uroughness");
        e.vRoughness = number(m.vRoughness, "vroughness");
    };
    switch (m.kind) {
    case MaterialKind::diffuse:
        e.reflectance = colour(m.reflectance, "reflectance");
        break;
    case MaterialKind::coatedDiffuse:
        e.reflectance = colour(m.reflectance, "reflectance");
        readRoughness();
        e.coat = makeCoat(m, e, index);
        break;
    case MaterialKind::coatedConductor:
        e.baseURoughness = number(m.baseURoughness, "conductor.uroughness");
        e.baseVRoughness = number(m.baseVRoughness, "conductor.vroughness");
        e.layers = {m.interfaceEta, thickness(m, index), m.maxDepth};
        [[fallthrough]];
    case MaterialKind::conductor:
        e.reflectanceConductor = m.reflectance >= 0;
        if (e.reflectanceConductor) {
            e.reflectance = colour(m.reflectance, "reflectance");
        } else {
            e.eta = colour(m.eta, "eta", TextureUse::unbounded);
            e.k = colour(m.k, "k", TextureUse::unbounded);
        }
        readRoughness();
        break;
    case MaterialKind::dielectric:
        readRoughness();
        break;
    case MaterialKind::diffuseTransmission:
        e.reflectance = colour(m.reflectance, "reflectance");
        e.transmittance = colour(m.transmittance, "transmittance");
        break;
    case MaterialKind::mix:
        e.amount = number(m.amount, "amount");
        break;
    case MaterialKind::thinDielectric:
    case MaterialKind::interface:
        break;
    }
    e.mayBeSpecular = m.kind == MaterialKind::mix || m.kind == MaterialKind::thinDielectric ||
                      ((m.kind == MaterialKind::conductor || m.kind == MaterialKind::coatedConductor ||
                        m.kind == MaterialKind::dielectric) &&
                       (e.uRoughness.texture >= 0 || e.vRoughness.texture >= 0 || facets(e, {}).smooth()));
    if (m.normalMapImage >= 0)
        e.normalMap = &scene.images[std::size_t(m.normalMapImage)];
    else if (m.displacement >= 0)
        e.displacement = number(m.displacement, "displacement");
    return e;
}

Materials::Parameter Materials::parameter(int texture, TextureUse use, const char* name,
                                          std::size_t material) const {
    if (!textures_.contains(texture))
        throw badInput(file_, "material {} has no texture for \"{}\"", material, name);
    if (!textures_.isConstant(texture)) return {texture, use, glm::vec3(0)};
    return {-1, use, textures_.evaluate(texture, TexturePoint{}, use)};
}

/// Of a coat without a scattering medium.
float Materials::thickness(const Material& material, std::size_t index) const {
    if (material.albedo >= 0) {
        Parameter albedo = parameter(material.albedo, TextureUse::albedo, "albedo", index);
        if (albedo.texture >= 0 || maxComponent(albedo.value) > 0)
            throw badInput(file_,
                           "material {}: a scattering medium (\"albedo\" above 0) in a coat is outside the "
                           "supported subset",
                           index);
    }
    Parameter thickness = parameter(material.thickness, TextureUse::number, "thickness", index);
    if (thickness.texture >= 0)
        throw badInput(
            file_, "material {}: a textured \"thickness\" of a coat is outside the supported subset", index);
    return std::max(thickness.value.x, 0.f);
}

std::unique_ptr<Coat> Materials::makeCoat(const Material& material, const Entry& entry,
                                          std::size_t index) const {
    float eta = material.interfaceEta == 0 ? 1.f : material.interfaceEta; // pbrt reads 0 as "no interface"
    if (!(eta > 0)) throw badInput(file_, "material {}: \"eta\" of coateddiffuse must be positive", index);
    float alphaMin = 0, alphaMax = 1;
    if (entry.uRoughness.texture < 0 && entry.vRoughness.texture < 0) {
        float u = alphaOf(entry.uRoughness.value.x, entry.remapRoughness);
        float v = alphaOf(entry.vRoughness.value.x, entry.remapRoughness);
        alphaMin = std::min(u, v);
        alphaMax = std::max(u, v);
    }
    return std::make_unique<Coat>(eta, thickness(material, index), material.maxDepth, alphaMin, alphaMax);
}

Microfacets Materials::facets(const Parameter& u, const Parameter& v, bool remap,
                              const TexturePoint& point) const {
    return {{alphaOf(value(u, point).x, remap), alphaOf(value(v, point).x, remap)}};
}

/// Index and absorption; of a metal that is given by its reflectance at normal incidence, such that it has
/// it.
std::pair<glm::vec3, glm::vec3> Materials::metal(const Entry& e, const TexturePoint& point) const {
    if (!e.reflectanceConductor) return {value(e.eta, point), value(e.k, point)};
    const glm::vec3 r = glm::clamp(value(e.reflectance, point), 0.f, 0.9999f);
    return {glm::vec3(1), 2.f * glm::sqrt(r) / glm::sqrt(1.f - r)};
}

/// Part of a mix by a number that depends on the place and the direction alone, as in pbrt.
const Materials::Entry& Materials::chosen(const SurfaceHit& hit, glm::vec3 wo) const {
    int index = hit.materialIndex;
    while (entries_[std::size_t(index)].kind == MaterialKind::mix) {
        const Entry& mix = entries_[std::size_t(index)];
        const float amount = value(mix.amount, {hit.position, hit.uv, hit.geometricNormal}).x;
        std::uint32_t hash = hashWords(hashVector(hit.position), hashVector(wo));
        const bool second = unitFloat(hashWords(hash, std::uint32_t(index))) < amount;
        index = mix.mixed[second];
    }
    return entries_[std::size_t(index)];
}

ShadingFrame Materials::bumped(const Entry& e, const SurfaceHit& hit) const {
    const glm::vec3 n = hit.shadingNormal;
    glm::vec3 normal, tangent = hit.dpdu;
    if (e.normalMap) {
        const glm::vec3 stored = 2.f * bilinear(*e.normalMap, {hit.uv.x, 1 - hit.uv.y}) - 1.f;
        const glm::vec3 x = glm::normalize(hit.dpdu);
        normal = stored.x * x + stored.y * glm::cross(n, x) + stored.z * n;
    } else {
        const auto displacement = [&](glm::vec3 step, glm::vec2 uvStep) {
            return value(e.displacement, {hit.position + step, hit.uv + uvStep, hit.geometricNormal}).x;
        };
        const float here = displacement({}, {});
        const float alongU = displacement(kBumpStep * hit.dpdu, {kBumpStep, 0}) - here;
        const float alongV = displacement(kBumpStep * hit.dpdv, {0, kBumpStep}) - here;
        tangent += alongU / kBumpStep * n;
        normal = glm::cross(tangent, hit.dpdv + alongV / kBumpStep * n);
    }
    const float length = glm::length(normal);
    if (!(length > 0) || !std::isfinite(length)) return {n, hit.dpdu};
    normal /= glm::dot(normal, hit.geometricNormal) < 0 ? -length : length;
    return {normal, tangent};
}

Bsdf Materials::bsdf(const SurfaceHit& hit, glm::vec3 wo) const {
    const Entry* entry = &entries_[std::size_t(hit.materialIndex)];
    if (entry->kind == MaterialKind::mix) entry = &chosen(hit, wo);
    const Entry& e = *entry;
    const TexturePoint point{hit.position, hit.uv, hit.geometricNormal};
    const auto [normal, tangent] = e.hasBumps() ? bumped(e, hit) : ShadingFrame{hit.shadingNormal, hit.dpdu};
    const auto reflectance = [&] { return glm::clamp(value(e.reflectance, point), 0.f, 1.f); };
    switch (e.kind) {
    case MaterialKind::diffuse:
        return Bsdf::diffuse(normal, wo, reflectance());
    case MaterialKind::coatedDiffuse:
        return Bsdf::coatedDiffuse(normal, tangent, wo, facets(e, point), *e.coat, reflectance());
    case MaterialKind::conductor: {
        const auto [eta, k] = metal(e, point);
        return Bsdf::conductor(normal, tangent, wo, facets(e, point), eta, k);
    }
    case MaterialKind::coatedConductor: {
        const auto [eta, k] = metal(e, point);
        const Microfacets base = facets(e.baseURoughness, e.baseVRoughness, e.remapRoughness, point);
        return Bsdf::coatedConductor(normal, tangent, wo, facets(e, point), e.layers, base,
                                     eta / e.layers.eta, k / e.layers.eta);
    }
    case MaterialKind::dielectric:
        return Bsdf::dielectric(normal, tangent, wo, facets(e, point), e.interfaceEta);
    case MaterialKind::thinDielectric:
        return Bsdf::thinDielectric(normal, wo, e.interfaceEta);
    case MaterialKind::diffuseTransmission:
        return Bsdf::diffuseTransmission(normal, wo, e.scale * reflectance(),
                                         e.scale * glm::clamp(value(e.transmittance, point), 0.f, 1.f));
    case MaterialKind::mix:
    case MaterialKind::interface:
        break;
    }
    return {};
}

} // namespace slant

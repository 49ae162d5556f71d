#include "scene/material_table.h"

#include "base/suggest.h"
#include "scene/spelling.h"
#include "scene/texture_table.h"

namespace slant {
namespace {

const ParameterList::Types kColourTypes{"rgb", "spectrum", "blackbody", "texture"};

constexpr std::string_view kKinds[] = {"diffuse", "coateddiffuse", "conductor"};

// pbrt does not limit these parameters of the random walk in a coating; these bounds limit the cost of a
// sample.
constexpr int kMaxLayerDepth = 1000, kMaxLayerSamples = 1000;

void readRoughness(Material& material, ParameterList& parameters, TextureTable& textures) {
    const int both = textures.floatTexture(parameters, "roughness", 0.f, kNonNegative);
    const int alongU = textures.floatTexture(parameters, "uroughness", std::nullopt, kNonNegative);
    const int alongV = textures.floatTexture(parameters, "vroughness", std::nullopt, kNonNegative);
    material.uRoughness = alongU >= 0 ? alongU : both;
    material.vRoughness = alongV >= 0 ? alongV : both;
    material.remapRoughness = parameters.flag("remaproughness", true);
}

void readCoatedDiffuse(Material& material, ParameterList& parameters, TextureTable& textures) {
    material.kind = MaterialKind::coatedDiffuse;
    material.reflectance =
        textures.spectrumTexture(parameters, "reflectance", SpectrumUse::albedo, glm::vec3(0.5f));
    readRoughness(material, parameters, textures);
    if (const Parameter* eta = parameters.find("eta", {"float", "spectrum"}))
        material.interfaceEta = eta->type == "float" ? *parameters.number("eta", kPositive) : glassEta(*eta);
    material.thickness = textures.floatTexture(parameters, "thickness", 0.01f, kNonNegative);
    material.g = parameters.number("g", 0, {-1, 1});
    material.albedo = textures.spectrumTexture(parameters, "albedo", SpectrumUse::albedo, glm::vec3(0));
    material.maxDepth = parameters.integer("maxdepth", 10, 0, kMaxLayerDepth);
    material.sampleCount = parameters.integer("nsamples", 1, 1, kMaxLayerSamples);
}

void readConductor(Material& material, ParameterList& parameters, TextureTable& textures) {
    material.kind = MaterialKind::conductor;
    material.reflectance =
        textures.spectrumTexture(parameters, "reflectance", SpectrumUse::albedo, std::nullopt);
    if (material.reflectance >= 0) {
        for (const std::string_view name : {"eta", "k"})
            if (parameters.find(name, kColourTypes))
                throw badInput(parameters.positionOf(name),
                               "a conductor has either 'reflectance' or 'eta' and 'k'");
    } else if (const std::optional<Metal> metal =
                   sampledMetal(parameters.find("eta", kColourTypes), parameters.find("k", kColourTypes))) {
        material.eta = textures.constant(metal->eta);
        material.k = textures.constant(metal->k);
    } else {
        material.eta = textures.spectrumTexture(parameters, "eta", SpectrumUse::unbounded,
                                                metalSpectrum("metal-Cu-eta"));
        material.k =
            textures.spectrumTexture(parameters, "k", SpectrumUse::unbounded, metalSpectrum("metal-Cu-k"));
    }
    readRoughness(material, parameters, textures);
}

Material readMaterial(const std::string& kind, ParameterList& parameters, TextureTable& textures) {
    Material material;
    if (kind == "diffuse")
        material.reflectance =
            textures.spectrumTexture(parameters, "reflectance", SpectrumUse::albedo, glm::vec3(0.5f));
    else if (kind == "coateddiffuse")
        readCoatedDiffuse(material, parameters, textures);
    else if (kind == "conductor")
        readConductor(material, parameters, textures);
    else
        throw unsupported(parameters.position(), "material \"{}\" is not supported{}", printable(kind),
                          didYouMean(kind, kKinds));
    parameters.finish();
    return material;
}

} // namespace

MaterialTable::MaterialTable(Issues& issues) : issues_(issues) {
    add("diffuse", ParameterList({}, "Material \"diffuse\"", {}, issues));
}

int MaterialTable::add(const std::string& kind, ParameterList parameters) {
    const Position where = parameters.position();
    entries_.push_back({"", where, kind, std::move(parameters)});
    return int(entries_.size()) - 1;
}

int MaterialTable::indexOf(const std::string& name, const Position& where) {
    const auto [entry, isNew] = named_.try_emplace(name, int(entries_.size()));
    if (isNew) entries_.push_back({name, where, "", std::nullopt});
    return entry->second;
}

int MaterialTable::use(const std::string& name, const Position& where) {
    return indexOf(name, where);
}

void MaterialTable::define(const std::string& name, const std::string& kind, ParameterList parameters,
                           bool mayReplace) {
    const Position where = parameters.position();
    int index = indexOf(name, where);
    if (entries_[std::size_t(index)].parameters) {
        if (!mayReplace) throw badInput(where, "the material '{}' is made twice", printable(name));
        named_[name] = index = int(entries_.size());
        entries_.emplace_back();
    }
    entries_[std::size_t(index)] = {name, where, kind, std::move(parameters)};
}

Material MaterialTable::built(Entry& entry, TextureTable& textures) const {
    if (entry.parameters) return readMaterial(entry.kind, *entry.parameters, textures);
    std::vector<std::string_view> names;
    for (const auto& [name, index] : named_)
        if (entries_[std::size_t(index)].parameters) names.push_back(name);
    throw badInput(entry.where, "there is no material '{}'{}", printable(entry.name),
                   didYouMean(entry.name, names));
}

void MaterialTable::build(Scene& scene, TextureTable& textures) {
    for (Entry& entry : entries_) {
        Material material;
        const auto work = [&] { material = built(entry, textures); };
        if (!issues_.attempt("grey stands in, diffuse with a reflectance of 0.5", work))
            material = {.reflectance = textures.constant(glm::vec3(0.5f))};
        scene.materials.push_back(material);
    }
}

} // namespace slant

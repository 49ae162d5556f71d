#include "scene/material_table.h"

#include "base/suggest.h"
#include "scene/scene_files.h"
#include "scene/spelling.h"
#include "scene/texture_table.h"

#include <algorithm>
#include <array>
#include <vector>

namespace slant {
namespace {

const ParameterList::Types kColourTypes{"rgb", "spectrum", "blackbody", "texture"};

// pbrt does not limit these parameters of the random walk in a coating; these bounds limit the cost of a
// sample.
constexpr int kMaxLayerDepth = 1000, kMaxLayerSamples = 1000;
constexpr int kMaxMixDepth = 32;

/// Roughness along u and v, of parameters whose names begin like this.
std::array<int, 2> roughness(const std::string& prefix, ParameterList& parameters, TextureTable& textures) {
    const auto read = [&](const char* name, std::optional<float> fallback) {
        return textures.floatTexture(parameters, prefix + name, fallback, kNonNegative);
    };
    const int both = read("roughness", 0.f), alongU = read("uroughness", {}), alongV = read("vroughness", {});
    return {alongU >= 0 ? alongU : both, alongV >= 0 ? alongV : both};
}

void readRoughness(Material& material, ParameterList& parameters, TextureTable& textures,
                   const std::string& prefix = "") {
    const auto [u, v] = roughness(prefix, parameters, textures);
    material.uRoughness = u;
    material.vRoughness = v;
    material.remapRoughness = parameters.flag("remaproughness", true);
}

/// What lies between a coat's interface and its base.
void readGap(Material& material, ParameterList& parameters, TextureTable& textures) {
    material.thickness = textures.floatTexture(parameters, "thickness", 0.01f, kNonNegative);
    material.g = parameters.number("g", 0, {-1, 1});
    material.albedo = textures.spectrumTexture(parameters, "albedo", SpectrumUse::albedo, glm::vec3(0));
    material.maxDepth = parameters.integer("maxdepth", 10, 0, kMaxLayerDepth);
    material.sampleCount = parameters.integer("nsamples", 1, 1, kMaxLayerSamples);
}

/// The index of refraction of an interface, the same for all colours.
void readIndex(Material& material, ParameterList& parameters, std::string_view name) {
    if (const Parameter* eta = parameters.find(name, {"float", "spectrum"}))
        material.interfaceEta = eta->type == "float" ? *parameters.number(name, kPositive) : glassEta(*eta);
}

void readDiffuse(Material& material, ParameterList& parameters, TextureTable& textures) {
    material.kind = MaterialKind::diffuse;
    material.reflectance =
        textures.spectrumTexture(parameters, "reflectance", SpectrumUse::albedo, glm::vec3(0.5f));
}

void readDiffuseTransmission(Material& material, ParameterList& parameters, TextureTable& textures) {
    material.kind = MaterialKind::diffuseTransmission;
    const auto part = [&](std::string_view name) {
        return textures.spectrumTexture(parameters, name, SpectrumUse::albedo, glm::vec3(0.25f));
    };
    material.reflectance = part("reflectance");
    material.transmittance = part("transmittance");
    material.scale = parameters.number("scale", 1, kNonNegative);
}

void readDielectric(Material& material, ParameterList& parameters, TextureTable& textures) {
    material.kind = MaterialKind::dielectric;
    readIndex(material, parameters, "eta");
    readRoughness(material, parameters, textures);
}

void readThinDielectric(Material& material, ParameterList& parameters, TextureTable&) {
    material.kind = MaterialKind::thinDielectric;
    readIndex(material, parameters, "eta");
}

void readCoatedDiffuse(Material& material, ParameterList& parameters, TextureTable& textures) {
    material.kind = MaterialKind::coatedDiffuse;
    material.reflectance =
        textures.spectrumTexture(parameters, "reflectance", SpectrumUse::albedo, glm::vec3(0.5f));
    readRoughness(material, parameters, textures);
    readIndex(material, parameters, "eta");
    readGap(material, parameters, textures);
}

/// A metal by its reflectance, or by its index.
void readMetal(Material& material, ParameterList& parameters, TextureTable& textures,
               const std::string& prefix) {
    material.reflectance =
        textures.spectrumTexture(parameters, "reflectance", SpectrumUse::albedo, std::nullopt);
    if (material.reflectance >= 0) {
        for (const std::string& name : {prefix + "eta", prefix + "k"})
            if (parameters.find(name, kColourTypes))
                throw badInput(parameters.positionOf(name),
                               "a conductor has either 'reflectance' or '{0}eta' and '{0}k'", prefix);
    } else if (const std::optional<Metal> metal = sampledMetal(parameters.find(prefix + "eta", kColourTypes),
                                                               parameters.find(prefix + "k", kColourTypes))) {
        material.eta = textures.constant(metal->eta);
        material.k = textures.constant(metal->k);
    } else {
        material.eta = textures.spectrumTexture(parameters, prefix + "eta", SpectrumUse::unbounded,
                                                metalSpectrum("metal-Cu-eta"));
        material.k = textures.spectrumTexture(parameters, prefix + "k", SpectrumUse::unbounded,
                                              metalSpectrum("metal-Cu-k"));
    }
}

void readConductor(Material& material, ParameterList& parameters, TextureTable& textures) {
    material.kind = MaterialKind::conductor;
    readMetal(material, parameters, textures, "");
    readRoughness(material, parameters, textures);
}

void readCoatedConductor(Material& material, ParameterList& parameters, TextureTable& textures) {
    material.kind = MaterialKind::coatedConductor;
    readMetal(material, parameters, textures, "conductor.");
    readIndex(material, parameters, "interface.eta");
    readRoughness(material, parameters, textures, "interface.");
    const auto [u, v] = roughness("conductor.", parameters, textures);
    material.baseURoughness = u;
    material.baseVRoughness = v;
    readGap(material, parameters, textures);
}

void readInterface(Material& material, ParameterList&, TextureTable&) {
    material.kind = MaterialKind::interface;
}

/// Kinds but mix, which needs the table.
struct Kind {
    std::string_view name;
    void (*read)(Material&, ParameterList&, TextureTable&);
};
constexpr Kind kKinds[] = {
    {"diffuse", readDiffuse},
    {"coateddiffuse", readCoatedDiffuse},
    {"conductor", readConductor},
    {"coatedconductor", readCoatedConductor},
    {"dielectric", readDielectric},
    {"thindielectric", readThinDielectric},
    {"diffusetransmission", readDiffuseTransmission},
    {"interface", readInterface},
};
constexpr std::string_view kMix = "mix";

/// Measured tables, of paints, fabrics and metals, that have to be taken on trust.
void standInForTable(Material& material, ParameterList& parameters, TextureTable& textures) {
    material.kind = MaterialKind::coatedDiffuse;
    material.reflectance = textures.constant(glm::vec3(0.5f));
    material.uRoughness = material.vRoughness = textures.constant(glm::vec3(0.3f));
    parameters.ignore({"filename", "bsdffile"});
    readGap(material, parameters, textures);
}

/// What a half-space of the medium reflects if light enters and leaves it freely (Jensen, Marschner, Levoy
/// and Hanrahan 2001, "A Practical Model for Subsurface Light Transport", section 2.3, A = 1).
glm::vec3 diffuseReflectance(glm::vec3 absorbed, glm::vec3 scattered) {
    const glm::vec3 albedo = scattered / glm::max(absorbed + scattered, 1e-30f);
    const glm::vec3 depth = glm::sqrt(3.f * (1.f - albedo));
    return albedo / 2.f * (1.f + glm::exp(-4.f / 3 * depth)) * glm::exp(-depth);
}

/// A coat of the same interface over what the medium reflects, as if light left where it enters.
void standInForSubsurface(Material& material, ParameterList& parameters, TextureTable& textures) {
    material.kind = MaterialKind::coatedDiffuse;
    material.interfaceEta = 1.33f;
    readIndex(material, parameters, "eta");
    readRoughness(material, parameters, textures);
    const auto coefficient = [&](std::string_view name, glm::vec3 perMillimetre) {
        const Parameter* p = findSpectrum(parameters, name);
        return p ? spectrumValue(*p, SpectrumUse::unbounded) : perMillimetre;
    };
    // pbrt's defaults, of whole milk.
    const glm::vec3 absorbed = coefficient("sigma_a", {0.0011f, 0.0024f, 0.014f});
    const glm::vec3 scattered = coefficient("sigma_s", {2.55f, 3.21f, 3.77f});
    const float g = parameters.number("g", 0, {-1, 1});
    material.reflectance = textures.spectrumTexture(parameters, "reflectance", SpectrumUse::albedo,
                                                    diffuseReflectance(absorbed, (1 - g) * scattered));
    parameters.ignore({"mfp", "scale", "name"});
    readGap(material, parameters, textures);
}

/// Kinds that --lenient has something nearer for than grey.
struct StandIn {
    std::string_view name, what;
    void (*read)(Material&, ParameterList&, TextureTable&);
};
constexpr StandIn kStandIns[] = {
    {"measured", "a grey, coated, rough diffuse material stands in", standInForTable},
    {"fourier", "a grey, coated, rough diffuse material stands in", standInForTable},
    {"subsurface", "\"coateddiffuse\" stands in", standInForSubsurface},
};

/// The normals that a material has of its own; as in pbrt, a normal map counts before a displacement.
void readBumps(Material& material, ParameterList& parameters, TextureTable& textures, SceneFiles& files) {
    material.displacement = textures.floatTexture(parameters, "displacement", std::nullopt);
    if (const std::optional<std::string> map = parameters.text("normalmap"); map && !map->empty())
        material.normalMapImage =
            files.image(*map, {ColourEncoding::Kind::linear}, false, parameters.positionOf("normalmap"));
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

Material MaterialTable::built(Entry& entry, TextureTable& textures, SceneFiles& files) {
    if (entry.parameters) return read(entry, textures, files);
    std::vector<std::string_view> names;
    for (const auto& [name, index] : named_)
        if (entries_[std::size_t(index)].parameters) names.push_back(name);
    throw badInput(entry.where, "there is no material '{}'{}", printable(entry.name),
                   didYouMean(entry.name, names));
}

void MaterialTable::readMix(Material& material, ParameterList& parameters, TextureTable& textures) {
    material.kind = MaterialKind::mix;
    const Position where = parameters.positionOf("materials");
    const Parameter* names = parameters.find("materials", {"string"});
    if (!names || names->strings.size() != material.mixed.size())
        throw badInput(where, "{} needs two names: \"string materials\"", parameters.subject());
    for (std::size_t i = 0; i < material.mixed.size(); ++i)
        material.mixed[i] = indexOf(names->strings[i], where);
    material.amount = textures.floatTexture(parameters, "amount", 0.5f);
}

Material MaterialTable::read(Entry& entry, TextureTable& textures, SceneFiles& files) {
    Material material;
    ParameterList& parameters = *entry.parameters;
    const auto* kind = std::ranges::find(kKinds, std::string_view(entry.kind), &Kind::name);
    if (entry.kind == kMix) {
        readMix(material, parameters, textures);
    } else if (kind != std::end(kKinds)) {
        kind->read(material, parameters, textures);
        if (material.kind != MaterialKind::interface) readBumps(material, parameters, textures, files);
    } else if (const auto* standIn = std::ranges::find(kStandIns, entry.kind, &StandIn::name);
               standIn != std::end(kStandIns)) {
        issues_.attempt(standIn->what, [&] {
            throw unsupported(parameters.position(), "material \"{}\" is not supported", standIn->name);
        });
        standIn->read(material, parameters, textures);
        readBumps(material, parameters, textures, files);
    } else if (entry.kind == "hair") {
        throw unsupported(parameters.position(),
                          "material \"hair\" is not supported: a sample has one depth, and"
                          " strands thinner than a pixel have many");
    } else {
        std::vector<std::string_view> names{kMix};
        for (const Kind& each : kKinds) names.push_back(each.name);
        throw unsupported(parameters.position(), "material \"{}\" is not supported{}", printable(entry.kind),
                          didYouMean(entry.kind, names));
    }
    parameters.finish();
    return material;
}

void MaterialTable::build(Scene& scene, TextureTable& textures, SceneFiles& files) {
    // A mix may name materials that are not made: they join the entries at their end.
    for (std::size_t i = 0; i < entries_.size(); ++i) {
        Entry& entry = entries_[i];
        Material material;
        const auto work = [&] { material = built(entry, textures, files); };
        if (!issues_.attempt("grey stands in, diffuse with a reflectance of 0.5", work))
            material = {.reflectance = textures.constant(glm::vec3(0.5f))};
        scene.materials.push_back(material);
    }
    checkMixes(scene);
}

void MaterialTable::checkMixes(const Scene& scene) const {
    // Materials that are known to end: every round adds the mixes of such.
    const auto count = scene.materials.size();
    std::vector<bool> ends(count);
    for (int round = 0; round < kMaxMixDepth; ++round)
        for (std::size_t i = 0; i < count; ++i) {
            const Material& m = scene.materials[i];
            const auto endsFor = [&](int part) { return bool(ends[std::size_t(part)]); };
            ends[i] = m.kind != MaterialKind::mix || std::ranges::all_of(m.mixed, endsFor);
        }
    for (std::size_t i = 0; i < count; ++i) {
        const Material& m = scene.materials[i];
        const Position& where = entries_[i].where;
        issues_.attempt("", [&] {
            if (!ends[i])
                throw badInput(where, "this material is a mix of itself, or nested more than {} deep",
                               kMaxMixDepth);
            if (m.kind != MaterialKind::mix) return;
            for (const int part : m.mixed)
                if (scene.materials[std::size_t(part)].kind == MaterialKind::interface)
                    throw badInput(where, "an \"interface\" cannot be part of a mix");
        });
    }
}

void dropInterfaces(Scene& scene) {
    const auto isInterface = [&](const Shape& shape) {
        return scene.materials[std::size_t(shape.materialIndex)].kind == MaterialKind::interface;
    };
    std::erase_if(scene.shapes, isInterface);
    for (ObjectDefinition& object : scene.objects) std::erase_if(object.shapes, isInterface);
}

} // namespace slant

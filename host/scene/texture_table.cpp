#include "scene/texture_table.h"

#include "base/suggest.h"
#include "scene/scene_files.h"
#include "scene/spelling.h"
#include "scene/tokenizer.h"

#include <charconv>

namespace slant {
namespace {

constexpr int kMaxTextureDepth = 100; // textures of textures; each level is a level of recursion

constexpr std::string_view kKinds[] = {"constant",     "scale",    "mix",      "bilerp",
                                       "checkerboard", "dots",     "imagemap", "directionmix",
                                       "fbm",          "wrinkled", "windy",    "marble"};
/// Finer ones are far below what a float can tell apart.
constexpr int kMaxOctaves = 32;

ColourEncoding encodingOf(ParameterList& parameters) {
    const std::optional<std::string> name = parameters.text("encoding");
    if (!name) return {};
    if (*name == "sRGB") return {ColourEncoding::Kind::srgb};
    if (*name == "linear") return {ColourEncoding::Kind::linear};
    if (name->starts_with("gamma ")) {
        float exponent = 0;
        const char* const end = name->data() + name->size();
        if (const auto result = std::from_chars(name->data() + 6, end, exponent);
            result.ec == std::errc() && result.ptr == end && exponent > 0 && exponent <= 10)
            return {ColourEncoding::Kind::gamma, exponent};
    }
    throw badInput(parameters.positionOf("encoding"),
                   "'encoding' is \"{}\", but must be \"sRGB\", \"linear\" or \"gamma N\"", printable(*name));
}

} // namespace

void TextureTable::define(bool isFloat, const std::string& name, const std::string& kind,
                          ParameterList parameters, const glm::dmat4& textureFromWorld, bool mayReplace) {
    const Position where = parameters.position();
    Definition definition{isFloat, kind, std::move(parameters), textureFromWorld};
    const auto [known, isNew] = definitions_.try_emplace({isFloat, name}, std::move(definition));
    if (isNew) return;
    if (!mayReplace)
        throw badInput(where, "the {} texture '{}' is defined twice", isFloat ? "float" : "spectrum",
                       printable(name));
    known->second = std::move(definition);
}

int TextureTable::constant(glm::vec3 value) {
    Texture texture;
    texture.value = value;
    scene_.textures.push_back(texture);
    return int(scene_.textures.size()) - 1;
}

/// Nothing where an older file goes on with a default.
std::optional<int> TextureTable::named(bool isFloat, const Parameter& parameter) {
    const std::string& name = parameter.strings[0];
    if (parameter.strings.size() != 1)
        throw badInput(parameter.position, "'{}' must have one value", parameter.name);
    const auto found = definitions_.find({isFloat, name});
    if (found != definitions_.end()) return build(found->second);
    const auto other = definitions_.find({!isFloat, name});
    if (older_ && isFloat && other != definitions_.end()) {
        issues_.note(parameter.position, fmt::format("the red of the spectrum texture '{}' is taken for '{}'",
                                                     printable(name), parameter.name));
        return build(other->second);
    }
    if (other != definitions_.end())
        throw badInput(parameter.position, "'{}' needs a {} texture, but '{}' is a {} texture",
                       parameter.name, isFloat ? "float" : "spectrum", printable(name),
                       isFloat ? "spectrum" : "float");
    std::vector<std::string_view> names;
    for (const auto& [key, definition] : definitions_)
        if (key.first == isFloat) names.push_back(key.second);
    const std::string missing =
        fmt::format("there is no {} texture '{}'", isFloat ? "float" : "spectrum", printable(name));
    if (!older_) throw badInput(parameter.position, "{}{}", missing, didYouMean(name, names));
    issues_.note(parameter.position, fmt::format("{}; '{}' has its default", missing, parameter.name));
    return {};
}

int TextureTable::floatTexture(ParameterList& parameters, std::string_view name,
                               std::optional<float> fallback, Range range) {
    const Parameter* parameter = parameters.find(name, {"float", "texture"});
    std::optional<float> value;
    if (parameter && parameter->type == "texture") {
        if (const std::optional<int> index = named(true, *parameter)) return *index;
    } else {
        value = parameters.number(name, range);
    }
    if (!value && !fallback) return -1;
    return constant(glm::vec3(value.value_or(fallback.value_or(0))));
}

int TextureTable::spectrumTexture(ParameterList& parameters, std::string_view name, SpectrumUse use,
                                  std::optional<glm::vec3> fallback) {
    const Parameter* parameter = parameters.find(name, {"rgb", "spectrum", "blackbody", "texture"});
    if (parameter && parameter->type == "texture") {
        if (const std::optional<int> index = named(false, *parameter)) return *index;
    } else if (parameter) {
        return constant(spectrumValue(*parameter, use));
    }
    return fallback ? constant(*fallback) : -1;
}

void TextureTable::buildAll() {
    for (auto& [key, definition] : definitions_) build(definition);
}

int TextureTable::build(Definition& definition) {
    if (definition.index >= 0) return definition.index;
    if (definition.inProgress)
        throw syntaxError(definition.parameters.position(), "this texture is made of itself");
    if (depth_ >= kMaxTextureDepth)
        throw syntaxError(definition.parameters.position(), "textures are nested more than {} deep",
                          kMaxTextureDepth);
    definition.inProgress = true;
    ++depth_;
    Texture texture;
    const auto work = [&] {
        texture = make(definition);
        definition.parameters.finish();
    };
    if (!issues_.attempt("a constant of 0.5 stands in", work)) texture = {.value = glm::vec3(0.5f)};
    --depth_;
    scene_.textures.push_back(texture);
    return definition.index = int(scene_.textures.size()) - 1;
}

int TextureTable::child(Definition& definition, std::string_view name, float fallback) {
    if (definition.isFloat) return floatTexture(definition.parameters, name, fallback);
    return spectrumTexture(definition.parameters, name, SpectrumUse::albedo, glm::vec3(fallback));
}

Texture TextureTable::make(Definition& definition) {
    ParameterList& parameters = definition.parameters;
    Texture texture;
    if (definition.kind == "constant") {
        if (definition.isFloat)
            texture.value = glm::vec3(parameters.number("value", 1));
        else if (const Parameter* value = findSpectrum(parameters, "value"))
            texture.value = spectrumValue(*value, SpectrumUse::albedo);
    } else if (definition.kind == "scale") {
        const bool isProduct = isColour(definition, "scale");
        texture.kind = isProduct ? TextureKind::product : TextureKind::scale;
        texture.child[0] = child(definition, "tex", 1);
        texture.child[1] = isProduct ? child(definition, "scale", 1) : floatTexture(parameters, "scale", 1.f);
    } else if (definition.kind == "mix") {
        texture.kind = TextureKind::mix;
        texture.child = {child(definition, "tex1", 0), child(definition, "tex2", 1),
                         floatTexture(parameters, "amount", 0.5f), -1};
    } else if (definition.kind == "checkerboard") {
        texture.kind = TextureKind::checkerboard;
        texture.child = {child(definition, "tex1", 1), child(definition, "tex2", 0), -1, -1};
        if (parameters.integer("dimension", 2, 2, 3) == 3)
            readSpace(texture, definition);
        else
            readMapping(texture, definition);
    } else if (definition.kind == "imagemap") {
        texture.kind = TextureKind::imagemap;
        readMapping(texture, definition);
        readImage(texture, definition);
    } else {
        makePattern(texture, definition);
    }
    return texture;
}

/// Whether a parameter, of older files, is a colour where pbrt-v4 has a number.
bool TextureTable::isColour(Definition& definition, std::string_view name) const {
    if (definition.isFloat) return false;
    const Parameter* parameter =
        definition.parameters.find(name, {"float", "texture", "rgb", "spectrum", "blackbody"});
    if (!parameter || parameter->type == "float") return false;
    if (parameter->type != "texture") return true;
    return !definitions_.contains({true, parameter->strings[0]}) &&
           definitions_.contains({false, parameter->strings[0]});
}

void TextureTable::makePattern(Texture& texture, Definition& definition) {
    ParameterList& parameters = definition.parameters;
    if (definition.kind == "bilerp") {
        texture.kind = TextureKind::bilerp;
        texture.child = {child(definition, "v00", 0), child(definition, "v01", 1),
                         child(definition, "v10", 0), child(definition, "v11", 1)};
        readMapping(texture, definition);
    } else if (definition.kind == "dots") {
        texture.kind = TextureKind::dots;
        texture.child = {child(definition, "inside", 1), child(definition, "outside", 0), -1, -1};
        readMapping(texture, definition);
    } else if (definition.kind == "directionmix") {
        // pbrt mixes from the second to the first as the normal turns to `dir`.
        texture.kind = TextureKind::directionMix;
        texture.child = {child(definition, "tex1", 0), child(definition, "tex2", 1), -1, -1};
        const glm::dmat3 worldFromTexture = glm::inverse(glm::dmat3(definition.textureFromWorld));
        const glm::vec3 dir = parameters.triple("dir", "vector3", {0, 1, 0});
        if (dir == glm::vec3(0)) throw badInput(parameters.positionOf("dir"), "'dir' must not be 0 0 0");
        texture.direction = glm::vec3(glm::normalize(worldFromTexture * glm::dvec3(dir)));
    } else if (definition.kind == "windy") {
        texture.kind = TextureKind::windy;
        readSpace(texture, definition);
    } else if (definition.kind == "fbm" || definition.kind == "wrinkled" || definition.kind == "marble") {
        texture.kind = definition.kind == "fbm"        ? TextureKind::fbm
                       : definition.kind == "wrinkled" ? TextureKind::wrinkled
                                                       : TextureKind::marble;
        texture.octaves = parameters.integer("octaves", 8, 0, kMaxOctaves);
        texture.roughness = parameters.number("roughness", 0.5f, {0, 1});
        if (texture.kind == TextureKind::marble) {
            texture.scale = parameters.number("scale", 1);
            texture.variation = parameters.number("variation", 0.2f);
        }
        readSpace(texture, definition);
    } else {
        throw unsupported(parameters.position(), "texture kind \"{}\" is not supported{}",
                          printable(definition.kind), didYouMean(definition.kind, kKinds));
    }
}

void TextureTable::readSpace(Texture& texture, Definition& definition) {
    texture.mapping = TextureMapping::space;
    texture.textureFromWorld = definition.textureFromWorld;
}

void TextureTable::readMapping(Texture& texture, Definition& definition) {
    ParameterList& parameters = definition.parameters;
    const std::string mapping =
        parameters.choice("mapping", "uv", {"uv", "planar", "spherical", "cylindrical"});
    const glm::vec2 delta(parameters.number("udelta", 0), parameters.number("vdelta", 0));
    const glm::vec2 scale(parameters.number("uscale", 1), parameters.number("vscale", 1));
    if (mapping == "uv" || mapping == "planar") texture.uvDelta = delta;
    if (mapping == "uv") {
        texture.uvScale = scale;
        return;
    }
    texture.textureFromWorld = definition.textureFromWorld;
    if (mapping != "planar") {
        texture.mapping = mapping == "spherical" ? TextureMapping::spherical : TextureMapping::cylindrical;
        return;
    }
    texture.mapping = TextureMapping::planar;
    texture.planarV1 = parameters.triple("v1", "vector3", {1, 0, 0});
    texture.planarV2 = parameters.triple("v2", "vector3", {0, 1, 0});
}

void TextureTable::readImage(Texture& texture, Definition& definition) {
    ParameterList& parameters = definition.parameters;
    const std::optional<std::string> filename = parameters.text("filename");
    if (!filename)
        throw badInput(parameters.position(), "{} needs \"string filename\"", parameters.subject());
    texture.imageIndex = files_.image(*filename, encodingOf(parameters), definition.isFloat,
                                      parameters.positionOf("filename"));
    const std::string wrap =
        parameters.choice("wrap", "repeat", {"repeat", "black", "clamp", "octahedralsphere"});
    texture.wrap = wrap == "repeat"  ? WrapMode::repeat
                   : wrap == "black" ? WrapMode::black
                   : wrap == "clamp" ? WrapMode::clamp
                                     : WrapMode::octahedralSphere;
    const std::string filter =
        parameters.choice("filter", "bilinear", {"point", "bilinear", "trilinear", "ewa", "EWA"});
    texture.filter = filter == "point" ? TexelFilter::point : TexelFilter::bilinear;
    texture.scale = parameters.number("scale", 1);
    texture.invert = parameters.flag("invert", false);
    parameters.ignore({"maxanisotropy"});
}

} // namespace slant

// The directives that make film, camera, materials, lights and shapes.
#include "base/monitor.h"
#include "base/suggest.h"
#include "scene/interpreter.h"
#include "scene/light_reader.h"
#include "scene/shape_reader.h"
#include "scene/spelling.h"

#include <algorithm>

namespace slant {
namespace {

enum class OptionEffect {
    none,       ///< never changes the expected picture
    unlessFalse ///< changes it if true
};
struct KnownOption {
    std::string_view name;
    OptionEffect effect;
};

/// pbrt's options, as it compares them: lower case, without '-' and '_'.
constexpr KnownOption kOptions[] = {
    {"seed", OptionEffect::none},
    {"disabletexturefiltering", OptionEffect::none}, // ray footprints are not used here
    {"displacementedgescale", OptionEffect::none},   // there is no displacement
    {"msereferenceimage", OptionEffect::none},
    {"msereferenceout", OptionEffect::none},
    {"rendercoordsys", OptionEffect::none},
    {"pixelstats", OptionEffect::none},
    {"wavefront", OptionEffect::none},
    {"disablepixeljitter", OptionEffect::unlessFalse},
    {"disablewavelengthjitter", OptionEffect::unlessFalse},
    {"forcediffuse", OptionEffect::unlessFalse},
};

std::string normalized(const std::string& name) {
    std::string result;
    for (const char c : name)
        if (c != '-' && c != '_') result += char(std::tolower(static_cast<unsigned char>(c)));
    return result;
}

} // namespace

ParameterList Interpreter::list(const std::string& subject, Tokenizer& tokens, const Position& where) {
    return {where, subject, readParameters(tokens)};
}

ParameterList Interpreter::list(const std::string& subject, Tokenizer& tokens, const Position& where,
                                AttributeTarget target) {
    return {where, subject, readParameters(tokens), state_.defaults[std::size_t(target)]};
}

void Interpreter::setOption(const char* directive, Tokenizer& tokens, const Position& where) {
    const std::string kind = stringOf(tokens.next());
    options_.set(directive, kind, list(fmt::format("{} \"{}\"", directive, printable(kind)), tokens, where));
}

void Interpreter::film(Tokenizer& tokens, const Position& where) {
    setOption("Film", tokens, where);
}
void Interpreter::pixelFilter(Tokenizer& tokens, const Position& where) {
    setOption("PixelFilter", tokens, where);
}
void Interpreter::sampler(Tokenizer& tokens, const Position& where) {
    setOption("Sampler", tokens, where);
}
void Interpreter::integrator(Tokenizer& tokens, const Position& where) {
    setOption("Integrator", tokens, where);
}

void Interpreter::accelerator(Tokenizer& tokens, const Position&) {
    stringOf(tokens.next());
    readParameters(tokens); // cannot change the picture
}

void Interpreter::camera(Tokenizer& tokens, const Position& where) {
    setOption("Camera", tokens, where);
    checkMotion(state_.transform, where);
    // As in pbrt the inverses are what is interpolated, not what the directives said.
    const MovingTransform worldFromCamera = inverse(state_.transform);
    options_.setCameraTransform(worldFromCamera, transformTimes_);
    coordinateSystems_["camera"] = worldFromCamera;
}

void Interpreter::option(Tokenizer& tokens, const Position&) {
    const Token name = tokens.next();
    const std::string key = normalized(stringOf(name));
    const Token value = tokens.next();
    if (value.kind != TokenKind::word && value.kind != TokenKind::string)
        throw badInput(value.position, "expected the value of option {}, found {}", name.shown(),
                       value.shown());
    const auto known = std::find_if(std::begin(kOptions), std::end(kOptions),
                                    [&](const KnownOption& o) { return o.name == key; });
    if (known == std::end(kOptions)) {
        std::vector<std::string_view> names;
        for (const KnownOption& o : kOptions) names.push_back(o.name);
        throw badInput(name.position, "unknown option {}{}", name.shown(), didYouMean(key, names));
    }
    if (known->effect == OptionEffect::unlessFalse && value.text != "false")
        throw badInput(value.position, "option {} is supported only as false", name.shown());
}

void Interpreter::colorSpace(Tokenizer& tokens, const Position&) {
    const Token token = tokens.next();
    if (stringOf(token) != "srgb")
        throw badInput(token.position, "colour space {} is not supported, only \"srgb\"", token.shown());
}

void Interpreter::mediumInterface(Tokenizer& tokens, const Position&) {
    do {
        const Token token = tokens.next();
        if (!stringOf(token).empty())
            throw badInput(token.position, "participating media are not supported, only \"\"");
    } while (tokens.peek().kind == TokenKind::string);
}

void Interpreter::reverseOrientation(Tokenizer&, const Position&) {
    state_.reverseOrientation = !state_.reverseOrientation;
}

void Interpreter::material(Tokenizer& tokens, const Position& where) {
    const std::string kind = stringOf(tokens.next());
    state_.materialIndex = materials_.add(kind, list(fmt::format("Material \"{}\"", printable(kind)), tokens,
                                                     where, AttributeTarget::material));
}

void Interpreter::makeNamedMaterial(Tokenizer& tokens, const Position& where) {
    const std::string name = stringOf(tokens.next());
    materials_.define(name, list(fmt::format("MakeNamedMaterial \"{}\"", printable(name)), tokens, where,
                                 AttributeTarget::material));
}

void Interpreter::namedMaterial(Tokenizer& tokens, const Position& where) {
    state_.materialIndex = materials_.use(stringOf(tokens.next()), where);
}

void Interpreter::warnIfMoving(const char* what, const Position& where) {
    if (state_.transform.moves())
        warn(where, fmt::format("{} does not move; its transform at the start is used", what));
}

void Interpreter::texture(Tokenizer& tokens, const Position& where) {
    constexpr std::string_view kTypes[] = {"float", "spectrum"};
    const std::string name = stringOf(tokens.next());
    const Token type = tokens.next();
    if (stringOf(type) != kTypes[0] && type.text != kTypes[1])
        throw badInput(type.position, "the type of a texture is \"float\" or \"spectrum\", not {}{}",
                       type.shown(), didYouMean(type.text, kTypes));
    const bool isFloat = type.text == kTypes[0];
    const std::string kind = stringOf(tokens.next());
    warnIfMoving("a texture", where);
    textures_.define(
        isFloat, name, kind,
        list(fmt::format("Texture \"{}\"", printable(name)), tokens, where, AttributeTarget::texture),
        affineInverse(state_.transform.at[0]));
}

void Interpreter::lightSource(Tokenizer& tokens, const Position& where) {
    const std::string kind = stringOf(tokens.next());
    ParameterList parameters =
        list(fmt::format("LightSource \"{}\"", printable(kind)), tokens, where, AttributeTarget::light);
    warnIfMoving("a light", where);
    scene_.lights.push_back(readLight(kind, parameters, state_.transform.at[0], scene_, files_));
}

void Interpreter::areaLightSource(Tokenizer& tokens, const Position& where) {
    const std::string kind = stringOf(tokens.next());
    ParameterList parameters =
        list(fmt::format("AreaLightSource \"{}\"", printable(kind)), tokens, where, AttributeTarget::light);
    scene_.areaLights.push_back(readAreaLight(kind, parameters, files_));
    state_.areaLightIndex = int(scene_.areaLights.size()) - 1;
}

/// Of a shape or an instance, while the shutter is open.
MovingTransform Interpreter::placement(const Position& where) const {
    checkMotion(state_.transform, where);
    return overShutter(state_.transform, transformTimes_, double(scene_.camera.shutterOpen),
                       double(scene_.camera.shutterClose));
}

void Interpreter::shape(Tokenizer& tokens, const Position& where) {
    const std::string kind = stringOf(tokens.next());
    ParameterList parameters =
        list(fmt::format("Shape \"{}\"", printable(kind)), tokens, where, AttributeTarget::shape);
    const MovingTransform worldFromObject = placement(where);
    const bool inObject = openObject_ >= 0;
    if (inObject && state_.areaLightIndex >= 0)
        warn(where, "shapes of an object cannot emit light, as in pbrt; this one is dark");
    auto& target = inObject ? scene_.objects[std::size_t(openObject_)].shapes : scene_.shapes;
    for (Shape& shape : readShapes(kind, parameters, scene_, files_, textures_)) {
        shape.worldFromObject = worldFromObject;
        shape.reverseOrientation = state_.reverseOrientation;
        shape.materialIndex = state_.materialIndex;
        shape.areaLightIndex = inObject ? -1 : state_.areaLightIndex;
        target.push_back(std::move(shape));
    }
}

void Interpreter::objectBegin(Tokenizer& tokens, const Position& where) {
    const std::string name = stringOf(tokens.next());
    if (openObject_ >= 0) throw badInput(where, "ObjectBegin within ObjectBegin");
    if (!objects_.try_emplace(name, int(scene_.objects.size())).second)
        throw badInput(where, "the object '{}' is defined twice", printable(name));
    push(true, where);
    openObject_ = int(scene_.objects.size());
    scene_.objects.push_back({name, {}});
}

void Interpreter::objectEnd(Tokenizer&, const Position& where) {
    pop(true, "ObjectEnd", "ObjectBegin", where);
    openObject_ = -1;
}

void Interpreter::objectInstance(Tokenizer& tokens, const Position& where) {
    const std::string name = stringOf(tokens.next());
    if (openObject_ >= 0) throw badInput(where, "ObjectInstance within ObjectBegin");
    instances_.push_back({name, placement(where), where});
}

} // namespace slant

// The directives that make film, camera, materials, lights and shapes.
#include "base/suggest.h"
#include "scene/interpreter.h"
#include "scene/light_reader.h"
#include "scene/older_pbrt.h"
#include "scene/shape_reader.h"
#include "scene/spectra.h"
#include "scene/spelling.h"

#include <algorithm>
#include <utility>

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

/// A sample has one depth, so none that is in a medium's midst.
Unsupported noMedia(const Position& where) {
    return unsupported(where, "participating media are not supported");
}

} // namespace

void Interpreter::noteOlder(const Position& where) {
    if (std::exchange(isOlder_, true)) return;
    textures_.takeForOlder();
    issues_.note(where, "this is of an older pbrt; the scene is read as pbrt's own upgrade translates it");
}

/// The parameters of an entity whose kind, as of pbrt-v4, goes into `kind`.
ParameterList Interpreter::list(std::string_view directive, std::string& kind, Tokenizer& tokens,
                                const Position& where, const ParameterVector& inherited) {
    const std::string subject = fmt::format("{} \"{}\"", directive, printable(kind));
    ParameterVector own = parameters(tokens);
    if (upgradeEntity(directive, where, kind, own, issues_)) noteOlder(where);
    return {where, subject, std::move(own), issues_, inherited};
}

ParameterVector Interpreter::parameters(Tokenizer& tokens) const {
    ParameterVector read = readParameters(tokens, state_.colourSpace);
    loadSpectra(read, files_);
    return read;
}

const ParameterVector& Interpreter::defaults(AttributeTarget target) const {
    return state_.defaults[std::size_t(target)];
}

void Interpreter::setOption(const char* directive, Tokenizer& tokens, const Position& where) {
    std::string kind = stringOf(tokens.next());
    ParameterList values = list(directive, kind, tokens, where);
    options_.set(directive, kind, std::move(values));
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

/// Of pbrt-v2; how light is followed is up to the SurfaceIntegrator.
void Interpreter::renderer(Tokenizer& tokens, const Position& where) {
    noteOlder(where);
    stringOf(tokens.next());
    parameters(tokens);
}

void Interpreter::worldEnd(Tokenizer&, const Position& where) {
    noteOlder(where);
}

void Interpreter::volume(Tokenizer&, const Position& where) {
    throw noMedia(where);
}

void Interpreter::accelerator(Tokenizer& tokens, const Position&) {
    stringOf(tokens.next());
    parameters(tokens); // cannot change the picture
}

void Interpreter::camera(Tokenizer& tokens, const Position& where) {
    setOption("Camera", tokens, where);
    checkInvertible(state_.transform, where);
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
        throw syntaxError(value.position, "expected the value of option {}, found {}", name.shown(),
                          value.shown());
    const auto known = std::find_if(std::begin(kOptions), std::end(kOptions),
                                    [&](const KnownOption& o) { return o.name == key; });
    if (known == std::end(kOptions)) {
        std::vector<std::string_view> names;
        for (const KnownOption& o : kOptions) names.push_back(o.name);
        throw unsupported(name.position, "unknown option {}{}", name.shown(), didYouMean(key, names));
    }
    if (known->effect == OptionEffect::unlessFalse && value.text != "false")
        throw unsupported(value.position, "option {} is supported only as false", name.shown());
}

void Interpreter::colorSpace(Tokenizer& tokens, const Position&) {
    const Token token = tokens.next();
    const ColourSpace* space = colourSpaceOf(stringOf(token));
    if (!space)
        throw badInput(token.position, "colour space {} is none of aces2065-1, dci-p3, rec2020 and srgb",
                       token.shown());
    state_.colourSpace = space->name == "srgb" ? nullptr : space; // what is ours needs no conversion
}

void Interpreter::mediumInterface(Tokenizer& tokens, const Position&) {
    do {
        const Token token = tokens.next();
        if (!stringOf(token).empty()) throw noMedia(token.position);
    } while (tokens.peek().kind == TokenKind::string);
}

void Interpreter::makeNamedMedium(Tokenizer&, const Position& where) {
    throw noMedia(where);
}

void Interpreter::reverseOrientation(Tokenizer&, const Position&) {
    state_.reverseOrientation = !state_.reverseOrientation;
}

void Interpreter::material(Tokenizer& tokens, const Position& where) {
    std::string kind = stringOf(tokens.next());
    ParameterList values = list("Material", kind, tokens, where, defaults(AttributeTarget::material));
    state_.materialIndex = materials_.add(kind, std::move(values));
}

void Interpreter::makeNamedMaterial(Tokenizer& tokens, const Position& where) {
    const std::string name = stringOf(tokens.next());
    const std::string subject = fmt::format("MakeNamedMaterial \"{}\"", printable(name));
    ParameterVector own = parameters(tokens);
    const std::optional<std::string> type = ParameterList(where, subject, own, issues_).text("type");
    std::string kind = type.value_or("diffuse");
    if (upgradeEntity("Material", where, kind, own, issues_)) noteOlder(where);
    ParameterList values(where, subject, std::move(own), issues_, defaults(AttributeTarget::material));
    values.ignore({"type"});
    materials_.define(name, kind, std::move(values), isOlder_);
    if (!type) throw badInput(where, "{} needs \"string type\"", subject);
}

void Interpreter::namedMaterial(Tokenizer& tokens, const Position& where) {
    state_.materialIndex = materials_.use(stringOf(tokens.next()), where);
}

void Interpreter::warnIfMoving(const char* what, const Position& where) {
    if (state_.transform.moves())
        issues_.note(where, fmt::format("{} does not move; its transform at the start is used", what));
}

void Interpreter::texture(Tokenizer& tokens, const Position& where) {
    constexpr std::string_view kTypes[] = {"float", "spectrum"}, kOlder = "color";
    const std::string name = stringOf(tokens.next());
    const Token type = tokens.next();
    if (stringOf(type) != kTypes[0] && type.text != kTypes[1] && type.text != kOlder)
        throw badInput(type.position, "the type of a texture is \"float\" or \"spectrum\", not {}{}",
                       type.shown(), didYouMean(type.text, kTypes));
    const bool isFloat = type.text == kTypes[0];
    std::string kind = stringOf(tokens.next());
    ParameterVector own = parameters(tokens);
    if (upgradeEntity("Texture", where, kind, own, issues_) || type.text == kOlder) noteOlder(where);
    checkInvertible(state_.transform, where);
    warnIfMoving("a texture", where);
    ParameterList values(where, fmt::format("Texture \"{}\"", printable(name)), std::move(own), issues_,
                         defaults(AttributeTarget::texture));
    textures_.define(isFloat, name, kind, std::move(values), affineInverse(state_.transform.at[0]), isOlder_);
}

void Interpreter::lightSource(Tokenizer& tokens, const Position& where) {
    std::string kind = stringOf(tokens.next());
    ParameterList values = list("LightSource", kind, tokens, where, defaults(AttributeTarget::light));
    checkInvertible(state_.transform, where);
    warnIfMoving("a light", where);
    scene_.lights.push_back(readLight(kind, values, state_.transform.at[0], files_));
}

void Interpreter::areaLightSource(Tokenizer& tokens, const Position& where) {
    state_.areaLightIndex = -1;
    std::string kind = stringOf(tokens.next());
    ParameterList values = list("AreaLightSource", kind, tokens, where, defaults(AttributeTarget::light));
    scene_.areaLights.push_back(readAreaLight(kind, values, files_));
    state_.areaLightIndex = int(scene_.areaLights.size()) - 1;
}

/// Of a shape or an instance, while the shutter is open; none for what is flattened to nothing.
std::optional<MovingTransform> Interpreter::placement(const Position& where) {
    if (!isInvertible(state_.transform)) {
        issues_.note(where, "the transform here is singular: what it flattens is left out");
        return {};
    }
    checkMotion(state_.transform, where);
    return overShutter(state_.transform, transformTimes_, double(scene_.camera.shutterOpen),
                       double(scene_.camera.shutterClose));
}

void Interpreter::shape(Tokenizer& tokens, const Position& where) {
    std::string kind = stringOf(tokens.next());
    ParameterList values = list("Shape", kind, tokens, where, defaults(AttributeTarget::shape));
    const std::optional<MovingTransform> worldFromObject = placement(where);
    if (!worldFromObject) return;
    const bool inObject = openObject_ >= 0;
    if (inObject && state_.areaLightIndex >= 0)
        issues_.note(where, "shapes of an object cannot emit light, as in pbrt; this one is dark");
    auto& target = inObject ? scene_.objects[std::size_t(openObject_)].shapes : scene_.shapes;
    for (Shape& shape : readShapes(kind, values, scene_, files_, textures_)) {
        shape.worldFromObject = *worldFromObject;
        shape.reverseOrientation = state_.reverseOrientation;
        shape.materialIndex = state_.materialIndex;
        shape.areaLightIndex = inObject ? -1 : state_.areaLightIndex;
        target.push_back(std::move(shape));
    }
}

void Interpreter::objectBegin(Tokenizer& tokens, const Position& where) {
    const std::string name = stringOf(tokens.next());
    if (openObject_ >= 0) throw syntaxError(where, "ObjectBegin within ObjectBegin");
    if (!objects_.insert_or_assign(name, int(scene_.objects.size())).second && !isOlder_)
        throw syntaxError(where, "the object '{}' is defined twice", printable(name));
    push(true, where);
    openObject_ = int(scene_.objects.size());
    scene_.objects.push_back({name, {}});
}

void Interpreter::objectEnd(Tokenizer&, const Position& where) {
    if (openObject_ < 0) throw syntaxError(where, "ObjectEnd without ObjectBegin");
    pop(true, "ObjectEnd", "ObjectBegin", where);
    openObject_ = -1;
}

void Interpreter::objectInstance(Tokenizer& tokens, const Position& where) {
    const std::string name = stringOf(tokens.next());
    if (openObject_ >= 0) throw syntaxError(where, "ObjectInstance within ObjectBegin");
    if (const std::optional<MovingTransform> transform = placement(where))
        instances_.push_back({name, *transform, where});
}

} // namespace slant

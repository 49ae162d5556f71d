#include "scene/light_reader.h"

#include "base/suggest.h"
#include "scene/scene_files.h"
#include "scene/spectra.h"
#include "scene/spelling.h"

namespace slant {
namespace {

constexpr std::string_view kKinds[] = {"point", "spot", "goniometric", "projection", "distant", "infinite"};
constexpr std::string_view kAreaKinds[] = {"diffuse"};

/// As in pbrt an empty name is none.
std::optional<std::string> imageNameOf(ParameterList& parameters) {
    std::optional<std::string> name = parameters.text("filename");
    if (name && name->empty()) name.reset();
    return name;
}

/// Without the parameter a light has the colour space's white at luminance 1, as in pbrt.
glm::vec3 emission(ParameterList& parameters, std::string_view name) {
    const Parameter* parameter = findSpectrum(parameters, name);
    return parameter ? spectrumValue(*parameter, SpectrumUse::illuminant) : glm::vec3(1);
}

/// pbrt takes a power or an illuminance only if it is above 0.
std::optional<float> positive(ParameterList& parameters, std::string_view name) {
    const std::optional<float> value = parameters.number(name);
    return value && *value > 0 ? value : std::nullopt;
}

void readPoint(Light& light, ParameterList& parameters) {
    light.kind = LightKind::point;
    light.emission = emission(parameters, "I");
    light.from = parameters.triple("from", "point3", {0, 0, 0});
    light.power = positive(parameters, "power");
}

void requireApart(const Light& light, ParameterList& parameters) {
    if (light.from == light.to)
        throw badInput(parameters.position(), "a {} light needs 'from' and 'to' apart",
                       light.kind == LightKind::spot ? "spot" : "distant");
}

void readSpot(Light& light, ParameterList& parameters) {
    readPoint(light, parameters);
    light.kind = LightKind::spot;
    light.to = parameters.triple("to", "point3", {0, 0, 1});
    requireApart(light, parameters);
    light.coneDegrees = parameters.number("coneangle", 30, {0, 180});
    light.coneDeltaDegrees = parameters.number("conedeltaangle", 5, {0, 180});
}

/// The image of a light that cannot be without one.
void readLightImage(Light& light, ParameterList& parameters, SceneFiles& files, bool average) {
    const std::optional<std::string> filename = imageNameOf(parameters);
    if (!filename)
        throw badInput(parameters.position(), "{} needs \"string filename\"", parameters.subject());
    light.imageIndex = files.image(*filename, {}, average, parameters.positionOf("filename"));
    light.power = positive(parameters, "power");
}

void readGoniometric(Light& light, ParameterList& parameters, SceneFiles& files) {
    light.kind = LightKind::goniometric;
    light.emission = emission(parameters, "I");
    readLightImage(light, parameters, files, true);
}

void readProjection(Light& light, ParameterList& parameters, SceneFiles& files) {
    light.kind = LightKind::projection;
    light.fovDegrees = parameters.number("fov", 90, {0, 179.99, true});
    readLightImage(light, parameters, files, false);
}

void readDistant(Light& light, ParameterList& parameters) {
    light.kind = LightKind::distant;
    light.emission = emission(parameters, "L");
    light.from = parameters.triple("from", "point3", {0, 0, 0});
    light.to = parameters.triple("to", "point3", {0, 0, 1});
    requireApart(light, parameters);
    light.illuminance = positive(parameters, "illuminance");
}

void readInfinite(Light& light, ParameterList& parameters, SceneFiles& files) {
    light.kind = LightKind::infinite;
    light.illuminance = positive(parameters, "illuminance");
    if (const std::vector<glm::vec3> portal = parameters.triples("portal", "point3"); !portal.empty()) {
        if (portal.size() != 4)
            throw badInput(parameters.positionOf("portal"), "'portal' needs four corners, not {}",
                           portal.size());
        light.portal = {portal[0], portal[1], portal[2], portal[3]};
    }
    const std::optional<std::string> filename = imageNameOf(parameters);
    if (!filename) {
        light.emission = emission(parameters, "L");
        return;
    }
    const Position where = parameters.positionOf("filename");
    if (findSpectrum(parameters, "L"))
        throw badInput(parameters.positionOf("L"), "an infinite light has either 'L' or 'filename'");
    light.imageIndex = files.environment(*filename, where);
}

} // namespace

Light readLight(const std::string& kind, ParameterList& parameters, const glm::dmat4& worldFromLight,
                SceneFiles& files) {
    Light light;
    light.worldFromLight = worldFromLight;
    light.location = parameters.position();
    light.scale = parameters.number("scale", 1, kNonNegative);
    if (kind == "point")
        readPoint(light, parameters);
    else if (kind == "spot")
        readSpot(light, parameters);
    else if (kind == "goniometric")
        readGoniometric(light, parameters, files);
    else if (kind == "projection")
        readProjection(light, parameters, files);
    else if (kind == "distant")
        readDistant(light, parameters);
    else if (kind == "infinite")
        readInfinite(light, parameters, files);
    else
        throw unsupported(parameters.position(), "light \"{}\" is not supported{}", printable(kind),
                          didYouMean(kind, kKinds));
    parameters.finish();
    return light;
}

AreaLight readAreaLight(const std::string& kind, ParameterList& parameters, SceneFiles& files) {
    if (kind != "diffuse")
        throw unsupported(parameters.position(), "area light \"{}\" is not supported{}", printable(kind),
                          didYouMean(kind, kAreaKinds));
    AreaLight light;
    if (const std::optional<std::string> filename = imageNameOf(parameters)) {
        if (findSpectrum(parameters, "L"))
            throw badInput(parameters.positionOf("L"), "an area light has either 'L' or 'filename'");
        light.imageIndex = files.image(*filename, {}, false, parameters.positionOf("filename"));
    } else {
        light.radiance = emission(parameters, "L");
    }
    light.scale = parameters.number("scale", 1, kNonNegative);
    light.twoSided = parameters.flag("twosided", false);
    light.power = positive(parameters, "power");
    parameters.finish();
    return light;
}

} // namespace slant

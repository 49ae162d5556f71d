#include "scene/light_reader.h"

#include "scene/scene_files.h"
#include "scene/spectra.h"
#include "scene/spelling.h"

#include <glm/gtc/constants.hpp>

namespace slant {
namespace {

constexpr std::string_view kKinds[] = {"point", "distant", "infinite"};
constexpr std::string_view kAreaKinds[] = {"diffuse"};

/// Without the parameter a light has the colour space's white at luminance 1, as pbrt has it.
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
    if (const auto power = positive(parameters, "power")) light.scale *= *power / (4 * glm::pi<float>());
}

void readDistant(Light& light, ParameterList& parameters) {
    light.kind = LightKind::distant;
    light.emission = emission(parameters, "L");
    light.from = parameters.triple("from", "point3", {0, 0, 0});
    light.to = parameters.triple("to", "point3", {0, 0, 1});
    if (light.from == light.to)
        throw badInput(parameters.position(), "a distant light needs 'from' and 'to' apart");
    if (const auto illuminance = positive(parameters, "illuminance")) light.scale *= *illuminance;
}

/// Direction of a point of the equal-area octahedral square. Clarberg: Fast Equal-Area Mapping of the
/// (Hemi)Sphere using SIMD, Journal of Graphics Tools 13(3), 2008; cos(theta) alone is needed here.
double octahedralCosTheta(double s, double t) {
    const double u = 2 * s - 1, v = 2 * t - 1;
    const double signedDistance = 1 - (std::abs(u) + std::abs(v));
    const double r = 1 - std::abs(signedDistance);
    return std::copysign(1 - r * r, signedDistance);
}

/// Irradiance (luminance-weighted) of the map's upper hemisphere (z up) on a horizontal patch.
double upperIlluminance(const Image& image) {
    double sum = 0;
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x) {
            const double cosTheta = octahedralCosTheta((x + 0.5) / image.width(), (y + 0.5) / image.height());
            if (cosTheta <= 0) continue;
            sum += cosTheta * (0.2126729 * image.at(x, y, 0) + 0.7151522 * image.at(x, y, 1) +
                               0.0721750 * image.at(x, y, 2));
        }
    return sum * 4 * glm::pi<double>() / (double(image.width()) * image.height());
}

void readInfinite(Light& light, ParameterList& parameters, const Scene& scene, SceneFiles& files) {
    light.kind = LightKind::infinite;
    const std::optional<float> illuminance = positive(parameters, "illuminance");
    const std::optional<std::string> filename = parameters.text("filename");
    if (!filename) {
        light.emission = emission(parameters, "L");
        if (illuminance) light.scale *= *illuminance / glm::pi<float>();
        return;
    }
    const Position where = parameters.positionOf("filename");
    if (findSpectrum(parameters, "L"))
        throw badInput(parameters.positionOf("L"), "an infinite light has either 'L' or 'filename'");
    light.imageIndex = files.image(*filename, {}, false, where);
    const Image& image = scene.images[std::size_t(light.imageIndex)];
    if (image.width() != image.height())
        throw badInput(
            where,
            "the image of an infinite light must be square (equal-area octahedral), but {} is {}x{}; "
            "convert a latitude-longitude map with: imgtool makeequiarea",
            *filename, image.width(), image.height());
    if (image.channelCount() != 3)
        throw badInput(where, "the image of an infinite light must have channels R, G and B");
    if (!illuminance) return;
    const double present = upperIlluminance(image);
    if (!(present > 0))
        throw badInput(where, "the upper half of this image is black: no illuminance to scale");
    light.scale *= float(*illuminance / present);
}

} // namespace

Light readLight(const std::string& kind, ParameterList& parameters, const glm::dmat4& worldFromLight,
                const Scene& scene, SceneFiles& files) {
    Light light;
    light.worldFromLight = worldFromLight;
    light.location = parameters.position();
    light.scale = parameters.number("scale", 1, kNonNegative);
    if (kind == "point")
        readPoint(light, parameters);
    else if (kind == "distant")
        readDistant(light, parameters);
    else if (kind == "infinite")
        readInfinite(light, parameters, scene, files);
    else
        throw badInput(parameters.position(), "light \"{}\" is not supported{}", printable(kind),
                       didYouMean(kind, kKinds));
    parameters.finish();
    return light;
}

AreaLight readAreaLight(const std::string& kind, ParameterList& parameters) {
    if (kind != "diffuse")
        throw badInput(parameters.position(), "area light \"{}\" is not supported{}", printable(kind),
                       didYouMean(kind, kAreaKinds));
    AreaLight light;
    light.radiance = emission(parameters, "L");
    light.scale = parameters.number("scale", 1, kNonNegative);
    light.twoSided = parameters.flag("twosided", false);
    light.power = positive(parameters, "power");
    parameters.finish();
    return light;
}

} // namespace slant

#include "scene/spectra.h"

#include "base/suggest.h"
#include "scene/spelling.h"

#include <algorithm>
#include <cmath>

namespace slant {
namespace {

struct NamedColour {
    std::string_view name;
    glm::vec3 rgb;
};

/// pbrt's metals. Fitted to its spectra of eta and k: the Fresnel reflectance of each channel follows that of
/// the spectrum under D65 (as linear Rec.709) over all angles, within 0.005. Red of gold lies outside the
/// colour space (1.02 at normal incidence) and becomes 1. CuZn: by hand, brass of (0.89, 0.79, 0.43).
constexpr NamedColour kMetals[] = {
    {"metal-Ag-eta", {0.1288f, 0.1256f, 0.1513f}},   {"metal-Ag-k", {4.0826f, 3.3620f, 2.4132f}},
    {"metal-Al-eta", {1.4195f, 0.9324f, 0.5917f}},   {"metal-Al-k", {7.7216f, 6.6140f, 5.3659f}},
    {"metal-Au-eta", {0.0100f, 0.4023f, 1.5747f}},   {"metal-Au-k", {3.2000f, 2.3410f, 1.7205f}},
    {"metal-Cu-eta", {0.1770f, 0.9731f, 1.2124f}},   {"metal-Cu-k", {3.6719f, 2.6233f, 2.3670f}},
    {"metal-CuZn-eta", {0.4440f, 0.5270f, 1.0940f}}, {"metal-CuZn-k", {3.6950f, 2.7650f, 1.8290f}},
    {"metal-MgO-eta", {1.7338f, 1.7409f, 1.7536f}},  {"metal-MgO-k", {0, 0, 0}},
    {"metal-TiO2-eta", {2.8624f, 2.9531f, 3.1859f}}, {"metal-TiO2-k", {0, 0, 0}},
};

struct NamedGlass {
    std::string_view name;
    float eta;
};

/// n_d of the maker's (Schott) data sheets; pbrt's F5, F10 and F11 are SF5, SF10 and SF11.
constexpr NamedGlass kGlasses[] = {
    {"glass-BK7", 1.5168f}, {"glass-BAF10", 1.6700f}, {"glass-FK51A", 1.4866f}, {"glass-LASF9", 1.8503f},
    {"glass-F5", 1.6727f},  {"glass-F10", 1.7283f},   {"glass-F11", 1.7847f},
};

constexpr double kVisibleFirst = 360, kVisibleLast = 830; // nm, pbrt's range

/// pbrt takes wavelength-value pairs; only those with one value have an exact RGB value here.
glm::vec3 sampledSpectrum(const Parameter& parameter, SpectrumUse use) {
    const std::vector<double>& pairs = parameter.numbers;
    bool constant = use != SpectrumUse::illuminant && pairs[0] <= kVisibleFirst &&
                    pairs[pairs.size() - 2] >= kVisibleLast;
    for (std::size_t i = 2; constant && i < pairs.size(); i += 2)
        constant = pairs[i] > pairs[i - 2] && pairs[i + 1] == pairs[1];
    if (!constant)
        throw badInput(parameter.position,
                       "'{}': spectra that vary over 360 to 830 nm are not supported; give \"rgb {}\"",
                       parameter.name, parameter.name);
    return glm::vec3(float(pairs[1]));
}

glm::vec3 namedSpectrum(const Parameter& parameter, SpectrumUse use) {
    const std::string& name = parameter.strings[0];
    if (parameter.strings.size() != 1)
        throw badInput(parameter.position, "'{}' must have one value", parameter.name);
    std::vector<std::string_view> known;
    if (use == SpectrumUse::illuminant) {
        if (name == "stdillum-D65") return glm::vec3(1); // the white of Rec.709
        known.push_back("stdillum-D65");
    } else {
        if (const std::optional<glm::vec3> metal = metalSpectrum(name)) return *metal;
        for (const NamedColour& metal : kMetals) known.push_back(metal.name);
    }
    throw badInput(parameter.position, "'{}': spectrum \"{}\" is not supported here; give \"rgb {}\"{}",
                   parameter.name, printable(name), parameter.name, didYouMean(name, known));
}

/// Lobe of the fits below: a Gaussian with its own width on either side.
double lobe(double x, double centre, double left, double right) {
    const double t = (x - centre) / (x < centre ? left : right);
    return std::exp(-0.5 * t * t);
}

/// CIE 1931 colour matching functions. Wyman, Sloan, Shirley: Simple Analytic Approximations to the CIE XYZ
/// Color Matching Functions, JCGT 2(2), 2013, the multi-lobe fit.
glm::dvec3 colourMatching(double nm) {
    return {1.056 * lobe(nm, 599.8, 37.9, 31.0) + 0.362 * lobe(nm, 442.0, 16.0, 26.7) -
                0.065 * lobe(nm, 501.1, 20.4, 26.2),
            0.821 * lobe(nm, 568.8, 46.9, 40.5) + 0.286 * lobe(nm, 530.9, 16.3, 31.1),
            1.217 * lobe(nm, 437.0, 11.8, 36.0) + 0.681 * lobe(nm, 459.0, 26.0, 13.8)};
}

/// IEC 61966-2-1.
glm::dvec3 rec709FromXyz(const glm::dvec3& xyz) {
    return {3.2404542 * xyz.x - 1.5371385 * xyz.y - 0.4985314 * xyz.z,
            -0.9692660 * xyz.x + 1.8760108 * xyz.y + 0.0415560 * xyz.z,
            0.0556434 * xyz.x - 0.2040259 * xyz.y + 1.0572252 * xyz.z};
}

} // namespace

std::optional<glm::vec3> metalSpectrum(std::string_view name) {
    for (const NamedColour& metal : kMetals)
        if (metal.name == name) return metal.rgb;
    return std::nullopt;
}

glm::vec3 blackbodyRgb(double kelvin) {
    constexpr double kSecondRadiation = 1.438776877e7; // h c / k in nm K
    glm::dvec3 xyz(0);
    for (double nm = kVisibleFirst; nm <= kVisibleLast; nm += 1) {
        // Planck's law relative to 560 nm, which cannot overflow for any temperature that is allowed.
        const double radiance = std::pow(560 / nm, 5) * std::expm1(kSecondRadiation / (560 * kelvin)) /
                                std::expm1(kSecondRadiation / (nm * kelvin));
        xyz += radiance * colourMatching(nm);
    }
    return glm::max(glm::vec3(rec709FromXyz(xyz / xyz.y)), glm::vec3(0));
}

glm::vec3 spectrumValue(const Parameter& parameter, SpectrumUse use) {
    glm::vec3 value;
    if (parameter.type == "blackbody") {
        if (use != SpectrumUse::illuminant || parameter.numbers.size() != 1)
            throw badInput(parameter.position, "blackbody '{}' must be one temperature of a light",
                           parameter.name);
        checkRange(parameter.numbers[0], {500, 1e6, false}, parameter);
        value = blackbodyRgb(parameter.numbers[0]);
    } else if (parameter.type == "spectrum") {
        value = parameter.strings.empty() ? sampledSpectrum(parameter, use) : namedSpectrum(parameter, use);
    } else {
        if (parameter.numbers.size() != 3)
            throw badInput(parameter.position, "rgb '{}' must have three values", parameter.name);
        value = {parameter.numbers[0], parameter.numbers[1], parameter.numbers[2]};
    }
    for (int c = 0; c < 3; ++c)
        checkRange(value[c], use == SpectrumUse::albedo ? Range{0, 1} : kNonNegative, parameter);
    return value;
}

float glassEta(const Parameter& parameter) {
    std::vector<std::string_view> known;
    for (const NamedGlass& glass : kGlasses) {
        if (parameter.strings.size() == 1 && glass.name == parameter.strings[0]) return glass.eta;
        known.push_back(glass.name);
    }
    throw badInput(parameter.position, "'{}': unknown glass \"{}\"; give \"float {}\"{}", parameter.name,
                   printable(parameter.strings.at(0)), parameter.name,
                   didYouMean(parameter.strings.at(0), known));
}

} // namespace slant

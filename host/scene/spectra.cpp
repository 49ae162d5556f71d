#include "scene/spectra.h"

#include "base/suggest.h"
#include "scene/scene_files.h"
#include "scene/spelling.h"

#include <algorithm>
#include <filesystem>

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

/// Chromaticities of CIE's illuminants, and of ACES' white.
struct Illuminant {
    std::string_view name;
    glm::dvec2 white;
};
constexpr Illuminant kIlluminants[] = {
    {"stdillum-A", {0.44757, 0.40745}},   {"stdillum-D50", {0.34567, 0.35850}},
    {"stdillum-F1", {0.31310, 0.33727}},  {"stdillum-F2", {0.37208, 0.37529}},
    {"stdillum-F3", {0.40910, 0.39430}},  {"stdillum-F4", {0.44018, 0.40329}},
    {"stdillum-F5", {0.31379, 0.34531}},  {"stdillum-F6", {0.37790, 0.38835}},
    {"stdillum-F7", {0.31292, 0.32933}},  {"stdillum-F8", {0.34588, 0.35875}},
    {"stdillum-F9", {0.37417, 0.37281}},  {"stdillum-F10", {0.34609, 0.35986}},
    {"stdillum-F11", {0.38052, 0.37713}}, {"stdillum-F12", {0.43695, 0.40441}},
    {"illum-acesD60", {0.32168, 0.33767}}};

std::optional<glm::vec3> illuminantRgb(std::string_view name) {
    if (name == "stdillum-D65") return glm::vec3(1); // the white of Rec.709
    for (const auto& [known, xy] : kIlluminants)
        if (known == name) return rec709FromXyz({xy.x / xy.y, 1, (1 - xy.x - xy.y) / xy.y});
    return {};
}

std::vector<std::string_view> knownNames(SpectrumUse use) {
    std::vector<std::string_view> names;
    if (use == SpectrumUse::illuminant) {
        names.push_back("stdillum-D65");
        for (const Illuminant& illuminant : kIlluminants) names.push_back(illuminant.name);
    } else {
        for (const NamedColour& metal : kMetals) names.push_back(metal.name);
    }
    return names;
}

/// Index of refraction at the line that catalogues give it for.
constexpr double kHeliumLineNm = 587.6;

glm::vec3 sampledRgb(const SampledSpectrum& spectrum, SpectrumUse use) {
    const auto function = [&](double nm) { return spectrum.at(nm); };
    if (use == SpectrumUse::illuminant) return glm::max(lightRgb(function), 0.f);
    if (spectrum.isConstant()) return glm::vec3(float(spectrum.at(kVisibleFirst)));
    const glm::vec3 rgb = glm::max(reflectanceRgb(function), 0.f);
    return use == SpectrumUse::albedo ? glm::min(rgb, 1.f) : rgb;
}

glm::vec3 namedSpectrum(const Parameter& parameter, SpectrumUse use) {
    const std::string& name = parameter.strings[0];
    if (parameter.strings.size() != 1)
        throw badInput(parameter.position, "'{}' must have one value", parameter.name);
    const std::optional<glm::vec3> known =
        use == SpectrumUse::illuminant ? illuminantRgb(name) : metalSpectrum(name);
    if (known) return glm::max(*known, 0.f);
    if (name.ends_with(".spd"))
        throw badInput(parameter.position, "{}: there is no such file", printable(name));
    throw unsupported(parameter.position, "'{}': spectrum \"{}\" is not supported here; give \"rgb {}\"{}",
                      parameter.name, printable(name), parameter.name, didYouMean(name, knownNames(use)));
}

bool isNamedSpectrum(std::string_view name) {
    return metalSpectrum(name) || illuminantRgb(name) ||
           std::any_of(std::begin(kGlasses), std::end(kGlasses),
                       [&](const NamedGlass& glass) { return glass.name == name; });
}

/// Older files name the metals by files that came with pbrt: "spds/metals/Au.eta.spd",
/// "Cu_palik.k.spd".
std::string metalOfFile(const std::string& path) {
    std::string name = std::filesystem::path(path).stem().string();
    if (const auto source = name.find("_palik"); source != name.npos) name.erase(source, 6);
    std::replace(name.begin(), name.end(), '.', '-');
    name.insert(0, "metal-");
    return metalSpectrum(name) ? name : "";
}

/// Wavelengths and values by turns.
std::vector<double> readSpectrumFile(const std::string& path, const Position& where) {
    const std::string text = readBytes(path, where);
    std::vector<double> pairs;
    try {
        Tokenizer tokens(text, &path);
        while (tokens.peek().kind != TokenKind::end) pairs.push_back(numberOf(tokens.next()));
    } catch (const Error& error) {
        throw badInput(where, "{}", error.what());
    }
    if (pairs.empty() || pairs.size() % 2 != 0)
        throw badInput(where, "{} must hold pairs of a wavelength and a value, but has {} numbers", path,
                       pairs.size());
    return pairs;
}

void checkWavelengths(const Parameter& parameter) {
    const std::vector<double>& pairs = parameter.numbers;
    for (std::size_t i = 2; i < pairs.size(); i += 2)
        if (!(pairs[i] > pairs[i - 2]))
            throw badInput(parameter.position, "'{}': wavelengths must ascend, but {} follows {}",
                           parameter.name, pairs[i], pairs[i - 2]);
}

/// In Rec.709; colours outside of it are clipped.
glm::vec3 rgbValue(const Parameter& parameter, SpectrumUse use) {
    if (parameter.numbers.size() != 3)
        throw badInput(parameter.position, "rgb '{}' must have three values", parameter.name);
    const glm::vec3 rgb{parameter.numbers[0], parameter.numbers[1], parameter.numbers[2]};
    for (int c = 0; c < 3; ++c)
        checkRange(rgb[c], use == SpectrumUse::albedo ? Range{0, 1} : kNonNegative, parameter);
    if (!parameter.colourSpace) return rgb;
    const glm::vec3 ours = use == SpectrumUse::illuminant ? rec709Light(*parameter.colourSpace, rgb)
                                                          : rec709Reflectance(*parameter.colourSpace, rgb);
    return glm::clamp(ours, 0.f, use == SpectrumUse::albedo ? 1.f : std::numeric_limits<float>::max());
}

} // namespace

std::optional<glm::vec3> metalSpectrum(std::string_view name) {
    for (const NamedColour& metal : kMetals)
        if (metal.name == name) return metal.rgb;
    return std::nullopt;
}

glm::vec3 blackbodyRgb(double kelvin) {
    return glm::max(lightRgb([&](double nm) { return blackbody(nm, kelvin); }), 0.f);
}

glm::dvec2 illuminantWhite(double kelvin) {
    // pbrt's constants are those of 1931 for daylight.
    if (kelvin >= 4000) return daylight(kelvin * 1.4388 / 1.4380);
    const glm::dvec3 xyz = xyzOf([&](double nm) { return blackbody(nm, kelvin); });
    return glm::dvec2(xyz) / (xyz.x + xyz.y + xyz.z);
}

glm::vec3 spectrumValue(const Parameter& parameter, SpectrumUse use) {
    if (parameter.type == "rgb") return rgbValue(parameter, use);
    if (parameter.type == "spectrum") {
        if (!parameter.strings.empty()) return namedSpectrum(parameter, use);
        for (std::size_t i = 1; i < parameter.numbers.size(); i += 2)
            checkRange(parameter.numbers[i], kNonNegative, parameter);
        return sampledRgb(SampledSpectrum(parameter.numbers), use);
    }
    if (use != SpectrumUse::illuminant || parameter.numbers.size() != 1)
        throw badInput(parameter.position, "blackbody '{}' must be one temperature of a light",
                       parameter.name);
    checkRange(parameter.numbers[0], {500, 1e6, false}, parameter);
    return blackbodyRgb(parameter.numbers[0]);
}

void loadSpectra(ParameterVector& parameters, const SceneFiles& files) {
    for (auto& parameter : parameters) {
        if (parameter->type != "spectrum") continue;
        if (parameter->strings.size() == 1 && !isNamedSpectrum(parameter->strings[0])) {
            const std::string path = files.resolve(parameter->strings[0]);
            const std::string metal = metalOfFile(path);
            std::error_code ignored;
            Parameter loaded = *parameter;
            if (std::filesystem::exists(path, ignored)) {
                loaded.strings.clear();
                loaded.numbers = readSpectrumFile(path, parameter->position);
            } else if (!metal.empty()) {
                loaded.strings[0] = metal;
            }
            parameter = std::make_shared<const Parameter>(std::move(loaded));
        }
        checkWavelengths(*parameter);
    }
}

std::optional<Metal> sampledMetal(const Parameter* eta, const Parameter* k) {
    const auto isSampled = [](const Parameter* p) {
        return p && p->type == "spectrum" && !p->numbers.empty() && !SampledSpectrum(p->numbers).isConstant();
    };
    if (!isSampled(eta) || !isSampled(k)) return {};
    const SampledSpectrum etas(eta->numbers), ks(k->numbers);
    return metalOf([&](double nm) { return etas.at(nm); }, [&](double nm) { return ks.at(nm); });
}

float glassEta(const Parameter& parameter) {
    if (parameter.strings.empty()) return float(SampledSpectrum(parameter.numbers).at(kHeliumLineNm));
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

// Colours and spectra of parameters as linear Rec.709 RGB.
#pragma once
#include "scene/parameters.h"
#include "scene/sampled_spectrum.h"

namespace slant {

class SceneFiles;

/// What a spectrum is for: reflectance in [0, 1], any non-negative quantity (eta, k), or emitted light, which
/// pbrt scales to luminance 1 before it applies "scale" (an rgb value multiplies that).
enum class SpectrumUse { albedo, unbounded, illuminant };

/// The parameter if it is of a type that spectrumValue takes; nullptr if there is none.
inline const Parameter* findSpectrum(ParameterList& parameters, std::string_view name) {
    return parameters.find(name, {"rgb", "spectrum", "blackbody"});
}

/// Throws Error(badInput) for spectra that have no RGB value here, and values out of range.
glm::vec3 spectrumValue(const Parameter& parameter, SpectrumUse use);

/// RGB value of a metal of pbrt's table, such as "metal-Cu-eta"; nothing for other names.
std::optional<glm::vec3> metalSpectrum(std::string_view name);

/// Index of refraction of a spectrum, a named glass or sampled, at 587.6 nm; throws Error(badInput) for
/// unknown names.
float glassEta(const Parameter& parameter);

/// The metal of two spectra that vary; nothing if one of them has the same value everywhere, or has none.
std::optional<Metal> sampledMetal(const Parameter* eta, const Parameter* k);

/// Replaces the names of spectrum files by what is in them. Throws Error(badInput).
void loadSpectra(ParameterVector& parameters, const SceneFiles& files);

/// Light of a black body of `kelvin` with luminance 1 (blue is clipped at 0 below about 1900 K).
glm::vec3 blackbodyRgb(double kelvin);

/// Chromaticity of what pbrt's white balance of `kelvin` (500 to 25000) makes white: daylight, below 4000 K a
/// black body.
glm::dvec2 illuminantWhite(double kelvin);

} // namespace slant

// Colour spaces of a scene's numbers, and the way from them to ours, linear Rec.709.
#pragma once
#include <glm/glm.hpp>
#include <string_view>

namespace slant {

/// Of linear RGB: CIE 1931 chromaticities of the primaries and of white.
struct ColourSpace {
    std::string_view name;
    glm::dvec2 red, green, blue, white;
};

/// pbrt's colour spaces, by their names in any case; null for other names.
const ColourSpace* colourSpaceOf(std::string_view name);

/// Rec.709 of a light, or of a reflectance, whose white stays white (Bradford). Out of gamut it is negative.
glm::vec3 rec709Light(const ColourSpace& space, const glm::vec3& rgb);
glm::vec3 rec709Reflectance(const ColourSpace& space, const glm::vec3& rgb);

glm::dvec3 rec709FromXyz(const glm::dvec3& xyz);

/// What makes light of the chromaticity `white` white, as a matrix on Rec.709 (Bradford).
glm::mat3 whiteBalance(const glm::dvec2& white);

/// Chromaticity of daylight, CIE D; `kelvin` from 4000 to 25000.
glm::dvec2 daylight(double kelvin);

} // namespace slant

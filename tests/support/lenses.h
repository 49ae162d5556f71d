// The lens files that come with Slant, and simple lenses from text.
#pragma once
#include "camera/lens_system.h"
#include "scene/lens_file.h"

#include <array>
#include <string>

namespace slant::test {

inline constexpr std::array kLensNames{"dgauss-50mm", "wide-22mm", "telephoto-250mm", "fisheye-10mm"};

inline LensPrescription lensNamed(const std::string& name) {
    return readLens(std::string(SLANT_SOURCE_DIR "/scenes/lenses/") + name + ".dat", {});
}

inline LensPrescription lensOf(const std::string& table) {
    return parseLens(table, "lens.dat");
}

inline LensSystem wideOpen(const LensPrescription& lens) {
    return LensSystem(lens, lens.surfaces[lens.stop].diameter);
}

/// Throughout the lens, towards the middle of the film at `film`.
inline LensRay rayFromFilm(glm::dvec3 film, glm::dvec3 through) {
    return {film, glm::normalize(through - film)};
}

} // namespace slant::test

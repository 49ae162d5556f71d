#include "scene/colour_space.h"

#include <algorithm>
#include <cctype>

namespace slant {
namespace {

constexpr glm::dvec2 kD65{0.3127, 0.3290}, kD60{0.32168, 0.33767};

constexpr ColourSpace kSpaces[] = {
    {"srgb", {0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, kD65},
    {"dci-p3", {0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}, kD65},
    {"rec2020", {0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046}, kD65},
    {"aces2065-1", {0.7347, 0.2653}, {0, 1}, {0.0001, -0.077}, kD60},
};

glm::dvec3 xyzOf(const glm::dvec2& xy) {
    return {xy.x / xy.y, 1, (1 - xy.x - xy.y) / xy.y};
}

/// The primaries scaled such that (1, 1, 1) is white of luminance 1.
glm::dmat3 xyzFromRgb(const ColourSpace& space) {
    const auto column = [](const glm::dvec2& xy) { return glm::dvec3(xy, 1 - xy.x - xy.y); };
    const glm::dmat3 primaries(column(space.red), column(space.green), column(space.blue));
    const glm::dvec3 scale = glm::inverse(primaries) * xyzOf(space.white);
    return {scale.x * primaries[0], scale.y * primaries[1], scale.z * primaries[2]};
}

/// Von Kries adaptation in the responses of Lam 1985 ("Bradford").
glm::dmat3 adaptation(const glm::dvec2& from, const glm::dvec2& to) {
    const glm::dmat3 lmsFromXyz(glm::dvec3(0.8951, -0.7502, 0.0389), glm::dvec3(0.2664, 1.7135, -0.0685),
                                glm::dvec3(-0.1614, 0.0367, 1.0296));
    const glm::dvec3 gain = (lmsFromXyz * xyzOf(to)) / (lmsFromXyz * xyzOf(from));
    const glm::dmat3 scaled(gain * lmsFromXyz[0], gain * lmsFromXyz[1], gain * lmsFromXyz[2]);
    return glm::inverse(lmsFromXyz) * scaled;
}

} // namespace

const ColourSpace* colourSpaceOf(std::string_view name) {
    const auto equal = [](char a, char b) {
        return std::tolower(static_cast<unsigned char>(a)) == static_cast<unsigned char>(b);
    };
    const auto found = std::find_if(std::begin(kSpaces), std::end(kSpaces), [&](const ColourSpace& s) {
        return std::equal(name.begin(), name.end(), s.name.begin(), s.name.end(), equal);
    });
    return found == std::end(kSpaces) ? nullptr : &*found;
}

glm::vec3 rec709Light(const ColourSpace& space, const glm::vec3& rgb) {
    return rec709FromXyz(xyzFromRgb(space) * glm::dvec3(rgb));
}

glm::vec3 rec709Reflectance(const ColourSpace& space, const glm::vec3& rgb) {
    return rec709FromXyz(adaptation(space.white, kD65) * xyzFromRgb(space) * glm::dvec3(rgb));
}

/// IEC 61966-2-1.
glm::dvec3 rec709FromXyz(const glm::dvec3& xyz) {
    return {3.2404542 * xyz.x - 1.5371385 * xyz.y - 0.4985314 * xyz.z,
            -0.9692660 * xyz.x + 1.8760108 * xyz.y + 0.0415560 * xyz.z,
            0.0556434 * xyz.x - 0.2040259 * xyz.y + 1.0572252 * xyz.z};
}

glm::mat3 whiteBalance(const glm::dvec2& white) {
    const glm::dmat3 xyz = xyzFromRgb(kSpaces[0]);
    return glm::mat3(glm::inverse(xyz) * adaptation(white, kD65) * xyz);
}

glm::dvec2 daylight(double kelvin) {
    const double t = 1000 / kelvin;
    const double x = kelvin <= 7000 ? ((-4.6070 * t + 2.9678) * t + 0.09911) * t + 0.244063
                                    : ((-2.0064 * t + 1.9018) * t + 0.24748) * t + 0.237040;
    return {x, (-3 * x + 2.870) * x - 0.275};
}

} // namespace slant

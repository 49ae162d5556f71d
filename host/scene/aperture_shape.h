// The shape of a lens's opening, by the name that scenes, options and light field files give it:
//
//     disc | gaussian | square | pentagon | star | polygon BLADES [DEGREES] | image WEIGHTS
//
// The second to fifth are those of pbrt-v4's realistic camera, with the same sizes. A polygon is regular,
// with its corners on the rim of the lens, one of them at the top, or turned counter-clockwise by DEGREES.
// Shapes stand upright in the blur of what lies behind the plane in focus. An image covers the square around
// the disc, and is cut to the disc.
#pragma once
#include "base/error.h"
#include "image/image.h"
#include "scene/position.h"
#include "shared/aperture.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace slant {

/// In lens coordinates: the unit disc, u to the right, v downwards. The disc itself has neither rim nor
/// weights, every other shape one of them.
struct ApertureShape {
    /// Sectors of the disc and rings in each, both evenly spaced: the cells of the weights.
    static constexpr int kSectors = kApertureSectors, kRings = kApertureRings;

    std::string name = "disc"; ///< as above, but just "image" without its weights
    /// Corners of an outline around the centre; the triangles between it and each side have the same area.
    std::vector<glm::dvec2> rim;
    /// Of the light that passes, sector by sector from the right clockwise, from the centre outwards: at
    /// least one is 255.
    std::vector<std::uint8_t> weights;
};

/// The shape of that name; nothing if it is none of the names. Throws Error(badInput) at `where` for a
/// polygon or weights that are malformed.
std::optional<ApertureShape> parseAperture(std::string_view text, const FileLocation& where);

/// What parseAperture takes.
std::string textOf(const ApertureShape& shape);

/// The mean of an image's channels as weights, its brightest pixel in the disc fully open. Throws
/// Error(badInput) at `where` if it is black there.
ApertureShape apertureOfImage(const Image& image, const FileLocation& where);

/// What `text` names: a shape, or else an image file, relative to `directory`. Throws Error(badInput) at
/// `where`.
ApertureShape readAperture(const std::string& text, const std::string& directory, const Position& where);

} // namespace slant

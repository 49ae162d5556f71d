// What a light field file holds besides its samples, and how both formats spell it.
//
// Names and values are the same in both: attributes "slant:NAME" of an OpenEXR header, lines "slant:NAME
// VALUE" at the end of a TLFR header.
#pragma once
#include "base/error.h"
#include "base/rect.h"
#include "image/exr.h"
#include "lightfield/lightfield.h"
#include "scene/scene.h"

#include <cstdint>
#include <optional>
#include <string>

namespace slant {

struct FieldMetadata {
    Rect film;                         ///< the whole picture, of which the field's frame is a part
    std::optional<PixelFilter> filter; ///< what the picture is to be filtered with
    float lensRadius = 0;              ///< in the unit of w; 0 = not known
    float focalLength = 0;             ///< in the unit of w; 0 = not known
    std::string unit;                  ///< of w and those two, "m" for example; empty = not known
    std::string source;                ///< the scene or program that it comes from
    std::uint64_t seed = 0;            ///< of the pattern
};

/// Everything that is known except the film, and the field's aperture unless it is a disc: strings, and
/// floats for lengths.
Metadata metadataOf(const LightField& field, const FieldMetadata& details);

/// Takes one of them, named without "slant:"; false if the name is unknown. Throws Error(badInput) for a
/// value out of range.
bool setMetadata(LightField& field, FieldMetadata& details, const FileLocation& location,
                 std::string_view name, const std::string& value);

/// "gaussian 1.5 1.5 0.5": kind, radii in pixels, then sigma of gaussian, B and C of mitchell, tau of sinc.
std::string filterText(const PixelFilter& filter);

/// The numbers of "1 2.5 -3", exactly `count`, each finite; nothing if the text is anything else.
std::optional<std::vector<double>> parseNumbers(std::string_view text, std::size_t count);

} // namespace slant

// OpenEXR scanline files with any named channels.
#pragma once
#include "image/image.h"

#include <map>
#include <string>
#include <variant>

namespace slant {

/// Attributes beyond those that OpenEXR itself defines; stored typed (string, float, int).
using Metadata = std::map<std::string, std::variant<std::string, float, int>>;

enum class ExrPrecision {
    half,    ///< rounded to nearest even; finite values beyond +-65504 become that, not infinite
    float32, ///< exact
};

struct ExrFile {
    Image image; ///< channels in the order R, G, B, A, then others by name; layers ("albedo.R") one by one
    Metadata metadata;
};

/// ZIP-compressed. Throws Error(resources) if the file cannot be written.
void writeExr(const std::string& path, const Image& image, const Metadata& metadata = {},
              ExrPrecision precision = ExrPrecision::half);

/// Channels of type half, float and uint, all as float. Throws Error(badInput) for anything but an intact
/// single-part scanline file, for subsampled channels, and for more than 2^27 pixels or 2^29 values.
ExrFile readExr(const std::string& path);

} // namespace slant

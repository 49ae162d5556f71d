// Pictures of all kinds that scenes name, told apart by their first bytes.
#pragma once
#include "image/image.h"

#include <string>

namespace slant {

struct Picture {
    Image image;          ///< channels Y, Y A, R G B or R G B A, of OpenEXR any
    bool encoded = false; ///< integers, scaled to [0, 1], that an encoding such as sRGB is to be undone from
};

/// PNG, OpenEXR, JPEG, Radiance HDR, PFM; TGA by its name. Up to 2^27 pixels. Throws Error(badInput) if it is
/// of another kind, damaged or cut short.
Picture readPicture(const std::string& path);

} // namespace slant

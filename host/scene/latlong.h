// Environment images by latitude and longitude, as older pbrt has them, made those of pbrt-v4.
#pragma once
#include "image/image.h"

namespace slant {

/// The square equal-area octahedral image of one twice as wide as high whose rows run from +z to -z and whose
/// columns run around z from +x, of about as many pixels.
Image octahedralOfLatLong(const Image& latLong);

} // namespace slant

// Pictures of where an image differs from its reference.
#pragma once
#include "image/image.h"
#include "image/png.h"

namespace slant {

/// The largest |error| of a pixel's channels from 0 (black) through purple, red and orange to `scale` and
/// above (pale yellow), lightness rising with it; green where either image is NaN or infinite. Both images
/// have the same size and channels (compare() checks); scale > 0.
Bitmap heatMap(const Image& image, const Image& reference, double scale);

} // namespace slant

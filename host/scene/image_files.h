// Images of textures and lights from files.
#pragma once
#include "image/image.h"
#include "scene/scene_files.h"

namespace slant {

/// An image of any kind that image/picture.h reads as linear values: R, G, B, or one channel Y if the file is
/// grey or with `average`, the mean of the colours. Alpha is dropped, as pbrt does for colours. Throws
/// Error(badInput) at `where`.
Image readImageFile(const std::string& path, ColourEncoding encoding, bool average, const Position& where);

} // namespace slant

// PNG files: 8-bit pictures out, textures and pictures in.
#pragma once
#include "image/image.h"

#include <cstdint>
#include <string>
#include <vector>

namespace slant {

/// sRGB-encoded pixels, row-major; 1 (grey) or 3 (R, G, B) bytes per pixel.
struct Bitmap {
    int width = 0, height = 0, channels = 3;
    std::vector<std::uint8_t> bytes;
};

/// What a screen shows of R, G, B (or of the first channel as grey, if one of them is missing) times
/// 2^exposureStops, clipped to [0, 1]; NaN becomes black.
Bitmap toSrgb8(const Image& image, float exposureStops = 0);

/// Throws Error(resources) if the file cannot be written.
void writePng(const std::string& path, const Bitmap& bitmap);

/// Any PNG of up to 2^27 pixels. Values as stored, not decoded, scaled to [0, 1]; channels Y, Y A, R G B or
/// R G B A (palettes become colours, transparent colours an A). Throws Error(badInput) if it is damaged.
Image readPng(const std::string& path);

} // namespace slant

#include "image/heat_map.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace slant {
namespace {

using Color = std::array<std::uint8_t, 3>;

/// Quarters of the colour map "magma" (van der Walt and Smith, 2015), sRGB.
constexpr std::array<Color, 5> kMagma = {
    {{0, 0, 4}, {81, 18, 124}, {183, 55, 121}, {252, 137, 97}, {252, 253, 191}}};
constexpr Color kNonFinite = {0, 255, 0};

/// `position` in [0, 1].
Color magma(double position) {
    const double quarter = position * (kMagma.size() - 1);
    const std::size_t below = std::min(std::size_t(quarter), kMagma.size() - 2);
    const double t = quarter - double(below);
    Color color{};
    for (std::size_t c = 0; c < 3; ++c)
        color[c] = std::uint8_t(std::lround((1 - t) * kMagma[below][c] + t * kMagma[below + 1][c]));
    return color;
}

} // namespace

Bitmap heatMap(const Image& image, const Image& reference, double scale) {
    Bitmap bitmap{image.width(), image.height(), 3, {}};
    const std::size_t channels = image.channels.size();
    for (std::size_t i = 0; i < image.pixels.size(); i += channels) {
        double largest = 0;
        for (std::size_t c = i; c < i + channels; ++c) {
            const double error = std::abs(double(image.pixels[c]) - reference.pixels[c]);
            // An infinite error beats all others; a NaN could get lost in comparisons.
            largest = std::max(largest, std::isfinite(error) ? error : HUGE_VAL);
        }
        const Color color = std::isfinite(largest) ? magma(std::min(largest / scale, 1.0)) : kNonFinite;
        bitmap.bytes.insert(bitmap.bytes.end(), color.begin(), color.end());
    }
    return bitmap;
}

} // namespace slant

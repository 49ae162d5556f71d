// The sRGB transfer curve (IEC 61966-2-1).
#pragma once
#include <cmath>

namespace slant {

/// Linear value of an encoded one; [0, 1] maps onto [0, 1].
inline float linearFromSrgb(float encoded) {
    return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

/// Encoded value of a linear one >= 0; [0, 1] maps onto [0, 1].
inline float srgbFromLinear(float linear) {
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

} // namespace slant

// FLIP: how different two pictures look to a person who flips between them on a screen.
// Andersson, Nilsson, Akenine-Moller, Oskarsson, Astrom and Fairchild, "FLIP: A Difference Evaluator for
// Alternating Images", Proc. ACM Comput. Graph. Interact. Tech. 3(2), 2020: the version for pictures in [0,
// 1].
#pragma once
#include "image/image.h"

namespace slant {

/// Pixels per degree of the visual field on the paper's screen: 3840 pixels on 0.7 m, seen from 0.7 m.
inline constexpr double kFlipPixelsPerDegree = 3840 / 0.7 * 0.7 * 3.14159265358979323846 / 180;

struct FlipOptions {
    float exposureStops = 0;
    double pixelsPerDegree = kFlipPixelsPerDegree; ///< > 0
};

struct Flip {
    Image map;       ///< one channel "FLIP", each pixel in [0, 1]
    double mean = 0; ///< of the map
};

/// Of the pictures that toSrgb8 shows, before they are rounded to 8 bits: R, G, B (else the first channel as
/// grey) times 2^exposureStops, clipped to [0, 1]; the screen undoes the sRGB curve. Symmetric; 0 for equal
/// images. If any value of either is NaN or infinite, map and mean are NaN. Throws Error(badInput) as
/// compare() does.
Flip flip(const Image& image, const Image& reference, const FlipOptions& options = {});

} // namespace slant

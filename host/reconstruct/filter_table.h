// The pixel filter as a table, so that any filter is one lookup on CPU and device alike.
#pragma once
#include "scene/scene.h"
#include "shared/reconstruct.h"

#include <vector>

namespace slant {

/// f(x, y) = weights[|dx|] * weights[offset.y + |dy|]: entry i of an axis is the filter at a distance of
/// (i + 0.5) / kSubpixels pixels, up to the radius. pbrt-v4's definitions; not normalised. After both axes
/// come, for each of them, the means over a pixel 0, 1, ... reach pixels away.
struct FilterTable {
    std::vector<float> weights; ///< x axis, y axis, means of x, means of y
    ivec2 length{0, 0};         ///< entries of each axis
    ivec2 reach{0, 0};          ///< pixels to each side whose samples count: ceil(radius - 0.5)
};

/// Throws Error(badInput) for a radius that is not in (0, 16].
FilterTable makeFilterTable(const PixelFilter& filter);

/// One axis of the filter at distance x >= 0 pixels, in double precision.
double evaluateFilterAxis(const PixelFilter& filter, double radius, double x);

} // namespace slant

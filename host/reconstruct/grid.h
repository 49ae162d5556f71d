// How the sparse grid over pinhole position and slope is laid out for one light field.
//
// A sample seen from the lens centre lies at p = (x, y) - slope (u, v), its pinhole position. An output at
// (x, y) looking through (u, v) sees it at p + slope (u, v). So samples binned by p and slope are found in a
// window of p whose width follows from the spread of slopes in one brick, however large the blur is.
#pragma once
#include "reconstruct/density.h"
#include "shared/motion.h"

namespace slant {

/// The radius R of the search, in pixels: slightly more than that of the largest empty circle in a sheared
/// pattern. On `spheres` 1.5 / sqrt(spp) gives the same error.
float emptyCircleRadius(float samplesPerPixel);

/// A search that finds nothing doubles its radius of 2 R up to three times.
constexpr int kWidenings = 3;
/// Margin of the samples that outputs of a picture can use.
float widestSearchPx(const SampleDensity& density);

/// Which samples are binned.
struct BinScope {
    Rect region;           ///< those that outputs of these pixels can use
    bool anyFocus = false; ///< whatever the focus: all that are not disabled
};
/// The margin to give `reaches`: widestSearchPx, or infinity.
float marginPx(const BinScope& scope, const SampleDensity& density);

/// The largest slope of the grid's buckets, to either side.
float largestSlope(const GridLayout& grid);

/// Lays the grid over the samples that are binned, with fewer than 2^32 cells in all, so that a sort key has
/// 32 bits. What lies outside by more than half the picture goes into the bricks of the rim and the first and
/// last bucket, which reach to infinity. Where things move, slopes are those of the whole shutter, and there
/// is room for kMinLayers layers.
GridLayout chooseGrid(const SceneSideSamples& samples, const SampleDensity& density, const BinScope& scope);
inline constexpr int kMinLayers = 1024;

} // namespace slant

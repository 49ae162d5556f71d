// How many samples per pixel lie around a place on a surface. Where pixels differ in their number of samples,
// this sets the own radii of samples, and so the whole search.
//
// A surface of slope s is seen at pinhole position p through rays of all pixels within |s| of p. So its
// samples are as dense there as in those pixels on average, less what something in front hides; the pixel in
// which they happen to be seen from the lens's centre does not matter. Pixels are summed over a square of
// that disc's area, at least 3 x 3 pixels.
#pragma once
#include "lightfield/scene_side.h"
#include "shared/reconstruct.h"

#include <vector>

namespace slant {

struct SampleDensity {
    DensityLayout layout{};
    std::vector<uint> sums{0}; ///< modulo 2^32; one unused texel if all pixels have equally many samples
    float least = 0,
          typical = 0; ///< samples per pixel where the field's samples are sparsest, and on average
};

SampleDensity densityOf(const SceneSideSamples& samples);

/// Samples per pixel.
float samplesAround(const SampleDensity& density, vec2 p, float slope);

/// R over the own radius of a sample: never below 1, and 1 if all pixels have equally many samples.
float radiusRatioAt(const SampleDensity& density, vec2 p, float slope, float radiusPx);

} // namespace slant

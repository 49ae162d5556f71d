// How many samples a pixel lie around a place on a surface: what own radii of samples, and so the whole
// search, follow where pixels differ in their number of samples.
//
// A surface of slope s is seen at pinhole position p through rays of all pixels within |s| of p. So its
// samples are as dense there as those pixels have them on average, less what something in front hides; not as
// the pixel is in which they happen to be seen from the lens's centre. Pixels are summed over a square of
// that disc's area, 3 x 3 pixels at least.
#pragma once
#include "lightfield/scene_side.h"
#include "shared/reconstruct.h"

#include <vector>

namespace slant {

struct SampleDensity {
    DensityLayout layout{};
    std::vector<uint> sums{0}; ///< modulo 2^32; one texel without use where all pixels have as many
    float least = 0,
          typical = 0; ///< samples per pixel where the field's samples are sparsest, and on average
};

SampleDensity densityOf(const SceneSideSamples& samples);

/// Samples a pixel.
float samplesAround(const SampleDensity& density, vec2 p, float slope);

/// R over the own radius of a sample: 1 where all pixels have as many, and never less.
float radiusRatioAt(const SampleDensity& density, vec2 p, float slope, float radiusPx);

} // namespace slant

// Stage "shading": less noise in the radiance of samples, from their neighbours on the same surface, before
// lens and shutter are integrated. The compute path makes the same words.
//
// Samples are put together by pinhole position into surfels, a pixel wide and up to two per texel: what blur
// spreads over the picture lies side by side there, and nothing is blurred twice. Their illumination
// (radiance over reflectance, so that textures stay out of it) is split into bands of detail by filters of
// growing width over surfels of one plane (the à-trous wavelets of Dammertz et al. 2010). Two halves of the
// samples have the same signal and independent noise, so their correlation in a band, averaged around a
// surfel, tells how much of the band is signal, and Wiener's filter keeps that much. Where there is no noise,
// and as samples grow, everything is kept.
#pragma once
#include "reconstruct/bins.h"
#include "shared/shading.h"

#include <vector>

namespace slant {

/// What a sample is to the filter: normal (xyz) and 1 / depth (w), which is 0 where there is nothing to
/// shade.
vec4 surfaceOf(const LightField& field, std::size_t sample);

/// Whether any surface reflects other than diffusely.
bool reflects(const LightField& field);

/// Bands of rows that cover the pinhole positions of what is seen (but for what is blurred by more than 128
/// pixels, whose noise is little), each with as many rows around as the filter reaches: those that are
/// changed are [firstRow, lastRow) of the texels.
struct ShadingBand {
    ShadingLayout layout;
    int firstRow, lastRow;
};
/// In so many bytes each, if possible; a band changes eight rows at least.
std::vector<ShadingBand> shadingBands(const GridLayout& grid, const Rect& region, bool reflects,
                                      std::uint64_t bytes);

/// Filters the radiance of the bins, which they have taken last, where it lies in the band's rows.
void filterShading(Bins& bins, const SceneSideSamples& samples, const ShadingBand& band);

} // namespace slant

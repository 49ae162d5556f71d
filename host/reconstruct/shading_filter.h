// Stage "shading": less noise in the radiance of samples, from their neighbours on the same surface, before
// lens and shutter are integrated. The compute path makes the same words.
//
// First, direct light: whether something is between a sample and places on lights is seen from the shadow
// rays of its neighbours (lib/soft_shadows.glsl), where the field has them.
//
// Then samples are put together by pinhole position into surfels, a pixel wide and up to two per texel: what
// blur spreads over the picture lies side by side there, and nothing is blurred twice. Their illumination
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

/// What a sample counts for in its surfel: one over the samples of its pixel, so that light does not seem
/// darker where more samples look at the dark.
float shadingWeight(const LightField& field, std::size_t sample);

/// The shadow ray of a sample: its position (xyz), and which share of the way to the light is free (w):
/// kUnblocked if all of it, 0 if there is no ray.
vec4 shadowRayOf(const LightField& field, std::size_t sample);

/// A band of rows of texels, with as many rows around as the filter reaches: those that are changed are
/// [firstRow, lastRow).
struct ShadingBand {
    ShadingLayout layout;
    int firstRow, lastRow;
};
struct ShadingPlan {
    bool reflects; ///< some surface does other than diffusely, so that light has two parts
    bool shadows;  ///< shadow rays are known
    /// Cover the pinhole positions of what is seen, but for what is blurred by more than 128 pixels: its
    /// noise is little.
    std::vector<ShadingBand> bands;
};
/// Bands in so many bytes each, if possible; a band changes eight rows at least.
ShadingPlan planShading(const LightField& field, const GridLayout& grid, std::uint64_t bytes);

/// Filters the radiance of the bins, which they have taken last.
void filterShading(Bins& bins, const SceneSideSamples& samples, const ShadingPlan& plan);

} // namespace slant

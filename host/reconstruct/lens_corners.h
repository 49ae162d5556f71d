// Where the outputs of a chunk look through a compound lens, at the corners of their tiles.
//
// Aberrations and places on the pupil change little over a tile, so outputs that are looked up in the layer
// map, as many as there are, take them from its corners instead of from the lens map.
#pragma once
#include "reconstruct/output_pattern.h"

#include <span>

namespace slant {

struct LensCorners {
    /// [output][row][column] of corners: aberration, pixels of the film; place on the entrance pupil.
    std::vector<vec4> rays;
};

/// Of outputs that look through `points` of the unit disc.
LensCorners lensCorners(const LensMap& lens, const OutputLayout& layout, std::span<const vec4> points);

/// Of the pixel at `position` in the layout's region.
PixelSight pixelSight(const LensMap& lens, const OutputLayout& layout, ivec2 position);
/// Takes output `plane` of the points, `fromMiddle` of the pixel, to the scene's side.
void lookFromCorners(const LensCorners& corners, const PixelSight& sight, int plane, vec2 fromMiddle,
                     Output& output);

} // namespace slant

// Outputs from the layer map: which lists of outputs can be taken from it, and how.
//
// A list (a tile of pixels, a group of lens positions) sees clusters of surfaces, with gaps in slope between
// them. Where each of them moves by a few pixels only from its nearest to its farthest part, an output looks
// its way through them front to back: in each it follows its ray to where the map has a layer of that slope,
// and composites what it finds. Its lens positions are the same in every pixel, and so free of noise.
#pragma once
#include "reconstruct/layer_map.h"
#include "reconstruct/output_pattern.h"
#include "reconstruct/plan.h"

#include <optional>

namespace slant {

/// A range of slopes, pixels per lens radius.
struct Cluster {
    float slopeMin, slopeMax;
};

/// The clusters of a list whose outputs look through `lens`, a part of the disc of radius `lensScale`, front
/// to back; empty where the outputs have to be searched for in the bins.
std::vector<Cluster> clustersOf(const Bins& bins, std::span<const uint> bricks, const LensBox& lens,
                                float lensScale, float reachPx);

/// Where the outputs of a pattern lie on the lens when they are taken from the map: the middles of their
/// cells.
std::vector<vec4> lensPoints(const OutputPattern& pattern);

/// See MapLayout::spreadPerPx.
float spreadPerPx(const OutputPattern& pattern);

/// Mean radiance of a pixel seen from `points`; nothing where one of them meets no surface.
std::optional<vec3> throughLayers(const LayerMap& map, std::span<const Cluster> clusters, vec2 pixelCenter,
                                  std::span<const vec4> points);

/// Adds to `share`, of the pixels of `frame` that a band finishes, what a chunk of its lists brings: of
/// `groups` in all, those whose rung is not 0.
void addMapShare(std::vector<float>& share, const Rect& frame, const Band& band, std::span<const uint> rungs,
                 std::size_t groups);

} // namespace slant

// Outputs from the layer map: which lists of outputs can be taken from it, and how.
//
// A list (a tile of pixels, a group of lens positions) sees clusters of surfaces, with gaps in slope between
// them. Where each of them moves by only a few pixels from its nearest to its farthest part, an output goes
// through them front to back: in each it follows its ray to where the map has a layer of that slope, and
// composites what it finds. Its lens positions are the same in every pixel, and so free of noise; what is in
// focus is looked up at the outputs' own places in the pixel, the rest at its middle.
#pragma once
#include "reconstruct/layer_map.h"
#include "reconstruct/output_pattern.h"

#include <optional>

namespace slant {

struct ListClass {
    std::vector<Cluster> clusters; ///< front to back; empty if outputs must be searched for in the bins
    bool inFocus = false; ///< one of them is in focus: each output counts at its own place in the pixel
    bool sparse = false;  ///< a few outputs are enough, wherever they come from

    /// As in the buffer of classes, see kInFocusBit and kSparseBit.
    uint code() const {
        return uint(clusters.size()) | (inFocus && !clusters.empty() ? kInFocusBit : 0) |
               (sparse ? kSparseBit : 0);
    }
};

/// Of outputs through `box`, a part of a thin lens's disc of radius `lensScale`.
LensSight sightThrough(const LensBox& box, float lensScale);

/// How to make the outputs of a list; where things move, from the first to the last of `times`.
ListClass classOfList(const Bins& bins, std::span<const uint> bricks, const LensSight& sight, vec2 times,
                      const MapLayout& map);

/// Where the outputs of a pattern lie on the lens, and when (from the middle of the shutter), if they are
/// taken from the map: in their cells, as evenly as possible.
std::vector<vec4> lensPoints(const OutputPattern& pattern);

/// See MapLayout::spreadPerPx.
float spreadPerPx(const OutputPattern& pattern);

/// What is seen at raster position x through lens position uv, on the scene's side, at `time` from the middle
/// of the shutter; nothing where no surface is met.
std::optional<vec3> lookThrough(const LayerMap& map, std::span<const Cluster> clusters, vec2 x, vec2 uv,
                                float time = 0);

} // namespace slant

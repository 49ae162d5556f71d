// Which tiles of outputs can see a brick through a compound lens: what tilesSeeing is for a thin lens.
//
// An output sees samples whose pinhole position is near xy - slope uv, both on the scene's side. For a lens
// group, each column and each row of tiles has bounds on that at a series of slopes. Between two slopes
// bounds are interpolated; this leaves nothing out, since the least value of linear functions is concave.
// Lower bounds are the minimum over all later tiles, upper bounds the maximum over all earlier ones, so that
// both ascend and bisection finds the tiles that see a brick. Where a lens distorts much, these are many more
// than do; so each tile has a box of its own, too.
#pragma once
#include "reconstruct/filter_table.h"
#include "reconstruct/tile_lists.h"
#include "shared/layer_map.h"

namespace slant {

struct LensTiles {
    /// [group][slope][low of columns, high of columns, low of rows, high of rows].
    std::vector<float> bounds;
    /// Of each list, kListBoxTexels: isSeen takes them (lib/grid.glsl). Where the film is dark, none sees.
    std::vector<vec4> boxes;
    /// Of each list: how its outputs see. Where the film is dark, all is 0.
    std::vector<LensSight> sights;
};

/// For the groups [firstGroup, firstGroup + groupCount) of a pattern.
LensTiles lensTilesOf(const LensMap& lens, const OutputPattern& pattern, std::size_t firstGroup,
                      std::size_t groupCount, const GridLayout& grid, const OutputLayout& layout,
                      float marginPx);

/// Tiles whose outputs in a group, counted from the first of `bounds`, can see a sample of a brick; where
/// things move, from the first to the last of `times`. Some do not: see listSees.
TileRange tilesOfCompoundLens(const Bins& bins, uint brick, const OutputLayout& layout,
                              std::span<const float> bounds, std::size_t group, vec2 times);

bool listSees(const Bins& bins, uint brick, const LensTiles& tiles, std::size_t list, vec2 times);

/// The region for whose outputs the samples of a picture are binned: its pixels and the filter's reach. For a
/// field with a lens map it is on the scene's side, and includes what its metric and pupils need beyond
/// widestSearchPx.
Rect searchRegionOf(const SceneSideSamples& samples, const FilterTable& filter);

} // namespace slant

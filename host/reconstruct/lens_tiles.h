// Which tiles of outputs can see a brick through a lens of many surfaces: what tilesSeeing is for a thin one.
//
// An output sees samples whose pinhole position is near xy - slope uv, both on the scene's side. For a lens
// group, each column and each row of tiles has bounds of that, at a series of slopes: between two of them
// bounds are interpolated, which leaves nothing out, as least values of linear functions are concave. Lower
// bounds are the least of all further tiles, upper ones the greatest of all before, so that both ascend and
// the tiles that see a brick are found by bisection.
#pragma once
#include "reconstruct/filter_table.h"
#include "reconstruct/tile_lists.h"

namespace slant {

/// Bounds for the groups [firstGroup, firstGroup + groupCount) of a pattern:
/// [group][slope][low of columns, high of columns, low of rows, high of rows].
std::vector<float> lensTileBounds(const LensMap& lens, const OutputPattern& pattern, std::size_t firstGroup,
                                  std::size_t groupCount, const GridLayout& grid, const OutputLayout& layout,
                                  float marginPx);

/// Tiles whose outputs in a group, counted from the first of `bounds`, can see a sample of `brick`.
TileRange tilesOfCompoundLens(const Brick& brick, const GridLayout& grid, const OutputLayout& layout,
                              std::span<const float> bounds, std::size_t group);

/// The region for whose outputs the samples of a picture are binned: its pixels and the filter's reach. Of a
/// field with a lens map it is on the scene's side, and with what its metric and pupils ask for beyond
/// widestSearchPx.
Rect searchRegionOf(const SceneSideSamples& samples, const FilterTable& filter);

} // namespace slant

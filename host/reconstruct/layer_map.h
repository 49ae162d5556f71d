// The layer map: what the lens centre sees, and what lies hidden behind it, half a pixel at a time.
//
// The light field of a scene that keeps still depends on pinhole position and slope alone, up to what hides
// what. So the samples around a pinhole position are told apart into surfaces once, for all outputs; the two
// foremost keep their mean slope and radiance and how much of the texel they cover. Through any lens position
// the surfaces are then found by lookups. Higher levels are means over 2x2 texels, for lens positions that
// lie far apart.
#pragma once
#include "reconstruct/bins.h"
#include "reconstruct/candidates.h"
#include "reconstruct/map_texel.h"

#include <vector>

namespace slant {

struct LayerMap {
    MapLayout layout{};
    std::vector<glm::uvec4> texels; ///< packed, a level after the other
};

/// How far a surface may move over the lens, pixels, so that the map serves it: as far as any does, up to a
/// bound.
float mapReach(const GridLayout& grid, float lensScale);
/// Texels along a pixel's side: a single one where no pixel has more samples than that.
int mapTexelsPerPixel(const LightField& field);
/// Rows of a band whose map fits into so many bytes. Throws Error(resources) where a row of tiles does not.
int mapRows(const Rect& frame, int texels, float reachPx, std::uint64_t bytes);

/// The texels that outputs of `region` can come to see, where the grid has samples; no levels coarser than
/// lens positions `spreadPerPx` apart on a surface blurred by a pixel need.
MapLayout chooseMap(const GridLayout& grid, const Rect& region, int texels, float reachPx, float spreadPerPx);
/// Texels of a level, and of all levels before it.
ivec2 levelSize(const MapLayout& map, int level);
std::size_t levelBegin(const MapLayout& map, int level);
/// Pinhole position of a texel of level 0.
vec2 texelCenter(const MapLayout& map, ivec2 texel);

/// The surfaces around the middle of a texel of level 0 (shaders/lib/map_sweep.glsl).
MapTexel resolveTexel(const SearchContext& context, const MapLayout& map, ivec2 texel);

/// The map's texels as outputs through the lens centre, for lists.
OutputLayout mapTiles(const MapLayout& map);

LayerMap makeLayerMap(const Bins& bins, const MapLayout& layout);

/// Fills a level of the map from the one below.
void reduceLevel(LayerMap& map, int level);

} // namespace slant

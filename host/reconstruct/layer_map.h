// The layer map: what the lens centre sees, and what is hidden behind that, at half a pixel's resolution.
//
// The light field of a scene that keeps still depends on pinhole position and slope alone, up to what hides
// what. So the samples around a pinhole position are split into surfaces once, for all outputs; the map keeps
// the mean slope and radiance of the two foremost, and how much of the texel they cover. Through any lens
// position the surfaces are then found by lookups. Coarser levels are means over 2x2 texels, for lens
// positions that lie far apart.
#pragma once
#include "reconstruct/bins.h"
#include "reconstruct/candidates.h"
#include "reconstruct/map_texel.h"

#include <vector>

namespace slant {

struct LayerMap {
    MapLayout layout{};
    std::vector<glm::uvec4> texels;  ///< packed, one level after the other
    std::vector<glm::uvec4> motions; ///< of the texels' layers, where things move; else empty
    MotionLayout motionLayout{};     ///< how these are packed
};

/// How far a surface may move over lens and shutter, in pixels, for the map to serve it: as far as any
/// surface does, up to a bound.
float mapReach(const GridLayout& grid, const MotionGrid& motion, float lensScale);
/// Texels along a pixel's side: one if no pixel has more than one sample.
int mapTexelsPerPixel(const LightField& field);
/// Rows of a band whose map fits into this many bytes. Throws Error(resources) if a row of tiles does not.
int mapRows(const Rect& frame, int texels, float reachPx, bool moves, std::uint64_t bytes);

/// The texels that outputs of `region` can see, where the grid has samples. The coarsest level is that needed
/// for lens positions `spreadPerPx` apart on a surface blurred by one pixel.
MapLayout chooseMap(const GridLayout& grid, const MotionGrid& motion, const Rect& region, int texels,
                    float reachPx, float spreadPerPx);
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

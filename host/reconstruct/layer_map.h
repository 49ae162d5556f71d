// The layer map: what the lens centre sees, and what is hidden behind that, at half a pixel's resolution.
//
// The light field of a scene that keeps still depends on pinhole position and slope alone, up to what hides
// what. So the samples around a pinhole position are split into surfaces once, for all outputs; the map keeps
// the mean slope and radiance of the two foremost, and how much of the texel they cover. Through any lens
// position the surfaces are then found by lookups. Coarser levels are means over 2x2 texels, for lens
// positions that lie far apart. Through a compound lens, whose pinhole positions are on its scene's side, the
// map is laid out as the film has them (camera/lens_distortion.h).
#pragma once
#include "camera/lens_distortion.h"
#include "reconstruct/bins.h"
#include "reconstruct/candidates.h"
#include "reconstruct/map_texel.h"
#include "reconstruct/output_pattern.h"

#include <vector>

namespace slant {

struct LayerMap {
    MapLayout layout{};
    std::vector<glm::uvec4> texels;  ///< packed, one level after the other
    std::vector<glm::uvec4> motions; ///< of the texels' layers, where things move; else empty
    MotionLayout motionLayout{};     ///< how these are packed
    std::vector<vec4> distortion;    ///< through a compound lens: of LensDistortion
};

/// For a map over the outputs of `region`; nothing for a thin lens.
LensDistortion distortionOver(const Rect& region, const LensMap& lens);
/// How far a surface may move over lens and shutter, in pixels, for the map to serve it: as far as any
/// surface does, up to a bound.
float mapReach(const GridLayout& grid, const MotionGrid& motion, float lensScale,
               const LensDistortion& distortion = {});
/// Texels along a pixel's side: one if no pixel has more than one sample.
int mapTexelsPerPixel(const LightField& field);
/// How far beyond what its outputs see a map reaches, on the film.
float mapMarginPx(float reachPx, const LensDistortion& distortion);
/// Rows of a band whose map fits into this many bytes. Throws Error(resources) if a row of tiles does not.
int mapRows(const Rect& frame, int texels, float marginPx, bool moves, std::uint64_t bytes);

/// The texels that outputs of `region` can see, where the grid has samples. The coarsest level is that needed
/// for lens positions `spreadPerPx` apart on a surface blurred by one pixel.
MapLayout chooseMap(const GridLayout& grid, const MotionGrid& motion, const Rect& region, int texels,
                    float reachPx, float spreadPerPx, const LensDistortion& distortion = {});
/// Texels of a level, and of all levels before it.
ivec2 levelSize(const MapLayout& map, int level);
std::size_t levelBegin(const MapLayout& map, int level);
/// Middle of a texel of level 0, on the film.
vec2 texelCenter(const MapLayout& map, ivec2 texel);

/// The surfaces around the middle of a texel of level 0 (shaders/lib/map_sweep.glsl); `pinhole` as of
/// LensDistortion.
MapTexel resolveTexel(const SearchContext& context, const MapLayout& map, const LensMap& pinhole,
                      ivec2 texel);

/// The map's texels as outputs through the lens centre, for lists.
OutputLayout mapTiles(const MapLayout& map);
OutputPattern mapPattern();

LayerMap makeLayerMap(const Bins& bins, const MapLayout& layout, const LensDistortion& distortion = {});

/// Fills a level of the map from the one below.
void reduceLevel(LayerMap& map, int level);

} // namespace slant

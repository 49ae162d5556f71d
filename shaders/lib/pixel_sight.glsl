// How the outputs of a pixel look through a compound lens, but for what lib/lens_corners.glsl adds.
//
// Needs, declared before the include: filmPlace of lib/lens_map.glsl. In C++ it is included in a struct that
// has that.
#include "shared/lens_map.h"
#include "shared/reconstruct.h"

/// Of the pixel at `position` in a region; `raster` is its middle.
KERNEL PixelSight pixelSight(ivec2 position, vec2 raster, ivec2 tileCount) {
    const FilmPlace film = filmPlace(raster);
    const vec2 e = film.e;
    const float along = film.here.y, across = film.here.z;
    const ivec2 tile = position / kTileSize;
    const int row = tileCount.x + 1;
    const PixelSight sight = {film.centre + turned(film, vec2(film.here.x, 0.0f)),
                              vec3(across + e.x * e.x * (along - across), e.x * e.y * (along - across),
                                   across + e.y * e.y * (along - across)),
                              film.inside ? film.here.w : 0.0f,
                              tile.y * row + tile.x,
                              row,
                              row * (tileCount.y + 1),
                              (vec2(position - tile * kTileSize) + 0.5f) * (1.0f / float(kTileSize))};
    return sight;
}

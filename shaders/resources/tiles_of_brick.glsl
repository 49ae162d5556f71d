// Which tiles can see a brick through a lens group, whatever the lens. Needs lensTileBoundAt
// (lib/lens_tiles.glsl).
#ifndef SLANT_RESOURCES_TILES_OF_BRICK_GLSL
#define SLANT_RESOURCES_TILES_OF_BRICK_GLSL
#include "lib/lens_tiles.glsl"
#include "resources/brick.glsl"
#include "resources/compound_lens.glsl"

/// `group` counts from the first of the chunk.
ivec4 tilesOfBrick(Brick brick, GridLayout grid, OutputLayout outputs, vec4 box, int group, float marginPx) {
    if (kCompoundLens) return tilesOfCompoundLens(brick, grid, outputs, group);
    return tilesSeeing(brick, grid, outputs, box, marginPx);
}
#endif

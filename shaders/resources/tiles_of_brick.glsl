// Which tiles can see a brick through a lens group, whatever the lens. Needs lensTileBoundAt
// (lib/lens_tiles.glsl), and the buffers bricks, brickMotions, brickOrder and motionTexels.
#ifndef SLANT_RESOURCES_TILES_OF_BRICK_GLSL
#define SLANT_RESOURCES_TILES_OF_BRICK_GLSL
#include "lib/lens_tiles.glsl"
#include "resources/compound_lens.glsl"
#include "resources/swept_brick.glsl"

/// Its number among the bricks; `rank` counts them front to back at the group's times, which `groupTimes`
/// has.
int brickAtRank(vec4 times, uint rank, uint brickTotal) {
    return kMoving ? int(texelFetch(brickOrder, int(uint(times.z) * brickTotal + rank)).x) : int(rank);
}

/// `group` counts from the first of the chunk. Through a compound lens not all of them do: see listSees.
ivec4 tilesOfBrick(int id, GridLayout grid, OutputLayout outputs, vec4 box, vec2 times, int group,
                   float marginPx) {
    if (kCompoundLens) return tilesOfCompoundLens(sweptAt(id, grid, times), grid, outputs, group);
    const Brick brick = brickOf(texelFetch(bricks, id));
    if (!kMoving) return tilesSeeing(brick, grid, outputs, box, marginPx);
    const BrickMotion motion = brickMotionOf(texelFetch(brickMotions, kBrickMotionTexels * id),
                                             texelFetch(brickMotions, kBrickMotionTexels * id + 1));
    return tilesSeeingMoving(brick, motion, grid, outputs, box, times, texelFetch(motionTexels, 0).x,
                             marginPx);
}
#endif

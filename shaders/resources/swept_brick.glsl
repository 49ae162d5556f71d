// A brick and where a lens group's times take it. Needs the buffers bricks, brickMotions and motionTexels.
#ifndef SLANT_RESOURCES_SWEPT_BRICK_GLSL
#define SLANT_RESOURCES_SWEPT_BRICK_GLSL
#include "lib/grid.glsl"
#include "resources/brick.glsl"
#include "resources/moving.glsl"

SweptBrick sweptAt(int id, GridLayout grid, vec2 times) {
    SweptBrick swept = sweptBrick(brickOf(texelFetch(bricks, id)), grid);
    if (kMoving)
        sweepOver(swept,
                  brickMotionOf(texelFetch(brickMotions, kBrickMotionTexels * id),
                                texelFetch(brickMotions, kBrickMotionTexels * id + 1)),
                  times, texelFetch(motionTexels, 0).x);
    return swept;
}
#endif

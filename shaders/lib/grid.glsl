// The sparse grid over pinhole positions and slopes (host/reconstruct/grid.h): where a sample is binned, what
// a brick holds, and which tiles can see it.
#ifndef SLANT_LIB_GRID_GLSL
#define SLANT_LIB_GRID_GLSL
#include "lib/trajectory.glsl"
#include "shared/reconstruct.h"

SLANT_SHARED_BEGIN

/// Whether any output of the region can use a sample (false for disabled samples).
KERNEL bool reaches(IN(Trajectory) trajectory, vec2 regionMin, vec2 regionMax, float marginPx) {
    if (isnan(trajectory.slope) || isinf(trajectory.slope)) return false;
    const vec2 p = trajectory.pinhole;
    const float reach = abs(trajectory.slope) + marginPx;
    return p.x + reach >= regionMin.x && p.x - reach <= regionMax.x && p.y + reach >= regionMin.y &&
           p.y - reach <= regionMax.y;
}

/// The cell of a place in cells from the origin.
KERNEL ivec2 cellAt(IN(GridLayout) grid, vec2 place) {
    const ivec2 cells = grid.brickCount * grid.cellsPerBrick;
    return ivec2(clamp(floor(place), vec2(0.0f), vec2(cells - 1)));
}

/// Bucket, row and column of a sample's brick, then its cell in the brick.
KERNEL uint sortKey(IN(GridLayout) grid, vec2 p, float slope) {
    const ivec2 cell = cellAt(grid, (p - grid.origin) * grid.invCell);
    const ivec2 brick = cell / grid.cellsPerBrick;
    const ivec2 inside = cell - brick * grid.cellsPerBrick;
    const float steps = floor((slope - grid.slopeMin) * grid.invBucket);
    const int bucket = int(clamp(steps, 0.0f, float(grid.bucketCount - 1)));
    const int key = (bucket * grid.brickCount.y + brick.y) * grid.brickCount.x + brick.x;
    return (uint(key) * uint(grid.cellsPerBrick) + uint(inside.y)) * uint(grid.cellsPerBrick) +
           uint(inside.x);
}

KERNEL ivec2 firstCell(IN(Brick) brick) {
    return ivec2(brick.firstCell & 0xffffu, brick.firstCell >> 16);
}
KERNEL ivec2 lastCell(IN(Brick) brick) {
    return firstCell(brick) + ivec2(brick.extent & 63u, brick.extent >> 6 & 63u);
}
/// First two words of a brick whose samples lie in the cells from `first` to `last`, the least of their R
/// over own radius being `radiusRatio`.
KERNEL uvec2 brickExtent(uvec2 first, uvec2 last, float radiusRatio) {
    const uvec2 extent = last - first;
    const uint radius = uint(ceil(kRadiusSteps / radiusRatio));
    return uvec2(first.x | first.y << 16, extent.x | extent.y << 6 | radius << 12);
}

/// Over R.
KERNEL float widestRadius(IN(Brick) brick) {
    return float(brick.extent >> 12) * (1.0f / kRadiusSteps);
}

KERNEL int tileOf(float px) {
    return int(floor(clamp(px * (1.0f / float(kTileSize)), -1e6f, 1e6f)));
}

/// Bricks of the rim reach to kFarPx.
KERNEL BrickBox boxOf(IN(Brick) brick, IN(GridLayout) grid) {
    const float cellPx = 1.0f / grid.invCell;
    const ivec2 first = firstCell(brick), last = lastCell(brick);
    const ivec2 rim = grid.brickCount * grid.cellsPerBrick - 1;
    BrickBox box = {grid.origin + vec2(first) * cellPx, grid.origin + vec2(last + 1) * cellPx};
    if (first.x == 0) box.low.x = -kFarPx;
    if (first.y == 0) box.low.y = -kFarPx;
    if (last.x == rim.x) box.high.x = kFarPx;
    if (last.y == rim.y) box.high.y = kFarPx;
    return box;
}

/// Tiles whose outputs, through lens positions of `lensBox` (min, max), can see a sample of the brick:
/// first.xy, last.zw, half-open; empty where last <= first.
KERNEL ivec4 tilesSeeing(IN(Brick) brick, IN(GridLayout) grid, IN(OutputLayout) outputs, vec4 lensBox,
                         float marginPx) {
    const float ownMarginPx = min(marginPx, max(marginPx * widestRadius(brick), kMinMarginPx));
    const BrickBox box = boxOf(brick, grid);
    const Motion motion =
        motionOver(vec2(lensBox), vec2(lensBox.z, lensBox.w), brick.slopeMin, brick.slopeMax);
    const vec2 from = box.low + motion.low - ownMarginPx - vec2(outputs.regionOrigin);
    const vec2 to = box.high + motion.high + ownMarginPx - vec2(outputs.regionOrigin);
    return ivec4(max(ivec2(tileOf(from.x), tileOf(from.y)), ivec2(0)),
                 min(ivec2(tileOf(to.x), tileOf(to.y)) + 1, outputs.tileCount));
}

SLANT_SHARED_END
#endif

// The sparse grid: where a sample is binned, and which tiles can see a brick. As host/reconstruct/bins.cpp and
// tile_lists.cpp.
#ifndef SLANT_LIB_GRID_GLSL
#define SLANT_LIB_GRID_GLSL
#include "shared/reconstruct.h"

const float kFarPx = 1e9; // further than any sample that can be seen

bool reaches(vec2 p, float slope, vec2 regionMin, vec2 regionMax, float marginPx) {
    if (isnan(slope) || isinf(slope)) return false;
    const float reach = abs(slope) + marginPx;
    return p.x + reach >= regionMin.x && p.x - reach <= regionMax.x && p.y + reach >= regionMin.y &&
           p.y - reach <= regionMax.y;
}

ivec2 cellAt(GridLayout grid, vec2 place) {
    const ivec2 cells = grid.brickCount * grid.cellsPerBrick;
    return ivec2(clamp(floor(place), vec2(0.0), vec2(cells - 1)));
}

/// Bucket, row and column of a sample's brick, then its cell in the brick.
uint sortKey(GridLayout grid, vec2 p, float slope) {
    const ivec2 cell = cellAt(grid, (p - grid.origin) * grid.invCell);
    const ivec2 brick = cell / grid.cellsPerBrick;
    const ivec2 inside = cell - brick * grid.cellsPerBrick;
    const float steps = floor((slope - grid.slopeMin) * grid.invBucket);
    const int bucket = int(clamp(steps, 0.0, float(grid.bucketCount - 1)));
    const int key = (bucket * grid.brickCount.y + brick.y) * grid.brickCount.x + brick.x;
    return (uint(key) * uint(grid.cellsPerBrick) + uint(inside.y)) * uint(grid.cellsPerBrick) + uint(inside.x);
}

Brick brickOf(uvec4 texel) {
    return Brick(texel.x, texel.y, uintBitsToFloat(texel.z), uintBitsToFloat(texel.w));
}

ivec2 cornerOf(Brick brick, GridLayout grid) {
    return grid.cellsPerBrick * ivec2(brick.place & 0xffffu, brick.place >> 16);
}

/// Occupied cells: first.xy, last.zw, inclusive.
ivec4 boxOf(Brick brick, GridLayout grid) {
    const ivec2 corner = cornerOf(brick, grid);
    return corner.xyxy +
           ivec4(brick.box & 0xffu, brick.box >> 8 & 0xffu, brick.box >> 16 & 0xffu, brick.box >> 24);
}

int tileOf(float px) { return int(floor(clamp(px * (1.0 / float(kTileSize)), -1e6, 1e6))); }

/// Tiles whose outputs, through lens positions of `box` (min, max), can see a sample of the brick: first.xy,
/// last.zw, half-open; empty where last <= first.
ivec4 tilesSeeing(Brick brick, GridLayout grid, OutputLayout outputs, vec4 box, float marginPx) {
    const float cellPx = 1.0 / grid.invCell;
    const ivec4 cells = boxOf(brick, grid);
    const ivec2 rim = grid.brickCount * grid.cellsPerBrick - 1;
    vec2 low = grid.origin + vec2(cells.xy) * cellPx;
    vec2 high = grid.origin + vec2(cells.zw + 1) * cellPx;
    if (cells.x == 0) low.x = -kFarPx;
    if (cells.y == 0) low.y = -kFarPx;
    if (cells.z == rim.x) high.x = kFarPx;
    if (cells.w == rim.y) high.y = kFarPx;
    const vec2 a = brick.slopeMin * box.xy, b = brick.slopeMin * box.zw;
    const vec2 c = brick.slopeMax * box.xy, d = brick.slopeMax * box.zw;
    const vec2 shearMin = min(min(a, b), min(c, d));
    const vec2 shearMax = max(max(a, b), max(c, d));
    const vec2 from = low + shearMin - marginPx - vec2(outputs.regionOrigin);
    const vec2 to = high + shearMax + marginPx - vec2(outputs.regionOrigin);
    return ivec4(max(ivec2(tileOf(from.x), tileOf(from.y)), ivec2(0)),
                 min(ivec2(tileOf(to.x), tileOf(to.y)) + 1, outputs.tileCount));
}
#endif

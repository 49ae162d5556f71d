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

ivec2 firstCell(Brick brick) { return ivec2(brick.firstCell & 0xffffu, brick.firstCell >> 16); }
ivec2 lastCell(Brick brick) { return firstCell(brick) + ivec2(brick.extent & 63u, brick.extent >> 6 & 63u); }
float widestRadius(Brick brick) { return float(brick.extent >> 12) * (1.0 / kRadiusSteps); }

int tileOf(float px) { return int(floor(clamp(px * (1.0 / float(kTileSize)), -1e6, 1e6))); }

/// Pinhole positions of its samples: min, max.
vec4 boxOf(Brick brick, GridLayout grid) {
    const float cellPx = 1.0 / grid.invCell;
    const ivec2 first = firstCell(brick), last = lastCell(brick);
    const ivec2 rim = grid.brickCount * grid.cellsPerBrick - 1;
    vec2 low = grid.origin + vec2(first) * cellPx;
    vec2 high = grid.origin + vec2(last + 1) * cellPx;
    if (first.x == 0) low.x = -kFarPx;
    if (first.y == 0) low.y = -kFarPx;
    if (last.x == rim.x) high.x = kFarPx;
    if (last.y == rim.y) high.y = kFarPx;
    return vec4(low, high);
}

/// Tiles whose outputs, through lens positions of `box` (min, max), can see a sample of the brick: first.xy,
/// last.zw, half-open; empty where last <= first.
ivec4 tilesSeeing(Brick brick, GridLayout grid, OutputLayout outputs, vec4 box, float marginPx) {
    const float ownMarginPx = min(marginPx, max(marginPx * widestRadius(brick), kMinMarginPx));
    const vec4 positions = boxOf(brick, grid);
    const vec2 low = positions.xy, high = positions.zw;
    const vec2 a = brick.slopeMin * box.xy, b = brick.slopeMin * box.zw;
    const vec2 c = brick.slopeMax * box.xy, d = brick.slopeMax * box.zw;
    const vec2 shearMin = min(min(a, b), min(c, d));
    const vec2 shearMax = max(max(a, b), max(c, d));
    const vec2 from = low + shearMin - ownMarginPx - vec2(outputs.regionOrigin);
    const vec2 to = high + shearMax + ownMarginPx - vec2(outputs.regionOrigin);
    return ivec4(max(ivec2(tileOf(from.x), tileOf(from.y)), ivec2(0)),
                 min(ivec2(tileOf(to.x), tileOf(to.y)) + 1, outputs.tileCount));
}
#endif

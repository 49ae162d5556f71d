// The sparse grid over pinhole positions and slopes (host/reconstruct/grid.h): where a sample is binned, what
// a brick holds, and which tiles can see it.
#ifndef SLANT_LIB_GRID_GLSL
#define SLANT_LIB_GRID_GLSL
#include "lib/motion.glsl"
#include "lib/trajectory.glsl"
#include "shared/reconstruct.h"

SLANT_SHARED_BEGIN

KERNEL bool isEnabled(IN(Trajectory) trajectory) {
    return abs(trajectory.slope) < kFarPx;
}

/// Whether any output of the region can use a sample (false for disabled samples).
KERNEL bool reaches(IN(Trajectory) trajectory, vec2 regionMin, vec2 regionMax, float marginPx) {
    if (!isEnabled(trajectory)) return false;
    const vec2 p = trajectory.pinhole;
    const float reach = abs(trajectory.slope) + marginPx;
    return p.x + reach >= regionMin.x && p.x - reach <= regionMax.x && p.y + reach >= regionMin.y &&
           p.y - reach <= regionMax.y;
}

/// The same for a point that moves: from shutter open to close it stays between where it is then.
KERNEL bool reachesMoving(IN(MovingPoint) point, vec2 regionMin, vec2 regionMax, float marginPx) {
    const Trajectory open = atTime(point.trajectory, point.motion, -0.5f),
                     shut = atTime(point.trajectory, point.motion, 0.5f);
    if (!(isEnabled(open) && isEnabled(shut))) return false;
    const vec2 low = min(open.pinhole, shut.pinhole), high = max(open.pinhole, shut.pinhole);
    const float reach = max(abs(open.slope), abs(shut.slope)) + marginPx;
    return high.x + reach >= regionMin.x && low.x - reach <= regionMax.x && high.y + reach >= regionMin.y &&
           low.y - reach <= regionMax.y;
}

/// The cell of a place in cells from the origin.
KERNEL ivec2 cellAt(IN(GridLayout) grid, vec2 place) {
    const ivec2 cells = grid.brickCount * grid.cellsPerBrick;
    return ivec2(clamp(floor(place), vec2(0.0f), vec2(cells - 1)));
}

KERNEL int bucketOf(IN(GridLayout) grid, float slope) {
    const float steps = floor((slope - grid.slopeMin) * grid.invBucket);
    return int(clamp(steps, 0.0f, float(grid.bucketCount - 1)));
}

/// Layer (the bucket of slopes, where nothing moves), row and column of a sample's brick, then its cell in
/// the brick.
KERNEL uint sortKey(IN(GridLayout) grid, vec2 p, int layer) {
    const ivec2 cell = cellAt(grid, (p - grid.origin) * grid.invCell);
    const ivec2 brick = cell / grid.cellsPerBrick;
    const ivec2 inside = cell - brick * grid.cellsPerBrick;
    const int key = (layer * grid.brickCount.y + brick.y) * grid.brickCount.x + brick.x;
    return (uint(key) * uint(grid.cellsPerBrick) + uint(inside.y)) * uint(grid.cellsPerBrick) +
           uint(inside.x);
}

/// Middle of a brick's square.
KERNEL vec2 brickCenter(IN(GridLayout) grid, ivec2 brick) {
    return grid.origin + (vec2(brick) + 0.5f) * (float(grid.cellsPerBrick) / grid.invCell);
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

/// Where a brick's samples are, and their slopes.
struct SweptBrick {
    BrickBox box;
    float slopeMin, slopeMax;
};

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

KERNEL SweptBrick sweptBrick(IN(Brick) brick, IN(GridLayout) grid) {
    const SweptBrick swept = {boxOf(brick, grid), brick.slopeMin, brick.slopeMax};
    return swept;
}
/// From the middle of the shutter to the first up to the last of `times`.
KERNEL void sweepOver(INOUT(SweptBrick) brick, IN(BrickMotion) motion, vec2 times, float c2) {
    if (keepsStill(motion)) return;
    SweptBrick swept = {{vec2(kInfinity), vec2(-kInfinity)}, kInfinity, -kInfinity};
    for (int corner = 0; corner < 4; ++corner) {
        const float time = (corner & 1) != 0 ? times.y : times.x;
        const float depth = 1.0f + time * ((corner & 2) != 0 ? motion.depthRate.y : motion.depthRate.x);
        const vec2 a = time * motion.low, b = time * motion.high;
        swept.box.low =
            min(swept.box.low, motion.center + (brick.box.low - motion.center + min(a, b)) / depth);
        swept.box.high =
            max(swept.box.high, motion.center + (brick.box.high - motion.center + max(a, b)) / depth);
        swept.slopeMin = min(swept.slopeMin, c2 + (brick.slopeMin - c2) / depth);
        swept.slopeMax = max(swept.slopeMax, c2 + (brick.slopeMax - c2) / depth);
    }
    brick = swept;
}

/// Tiles that overlap a box: first.xy, last.zw, half-open; empty where last <= first.
KERNEL ivec4 tilesOver(vec2 low, vec2 high, IN(OutputLayout) outputs) {
    const vec2 from = low - vec2(outputs.regionOrigin), to = high - vec2(outputs.regionOrigin);
    return ivec4(max(ivec2(tileOf(from.x), tileOf(from.y)), ivec2(0)),
                 min(ivec2(tileOf(to.x), tileOf(to.y)) + 1, outputs.tileCount));
}

/// Whether outputs at `xy` (low, high, with a margin) that look through `uv` (the same) can see a brick.
KERNEL bool isSeen(IN(SweptBrick) brick, vec4 xy, vec4 uv) {
    const Shift shift = shiftOver(vec2(uv), vec2(uv.z, uv.w), brick.slopeMin, brick.slopeMax);
    const vec2 low = vec2(xy) - shift.high, high = vec2(xy.z, xy.w) - shift.low;
    return brick.box.low.x <= high.x && brick.box.low.y <= high.y && brick.box.high.x >= low.x &&
           brick.box.high.y >= low.y;
}

/// Tiles whose outputs, through lens positions of `lensBox` (min, max), can see a sample of the brick:
/// first.xy, last.zw, half-open; empty where last <= first.
KERNEL ivec4 tilesSeeing(IN(Brick) brick, IN(GridLayout) grid, IN(OutputLayout) outputs, vec4 lensBox,
                         float marginPx) {
    const float ownMarginPx = min(marginPx, max(marginPx * widestRadius(brick), kMinMarginPx));
    const BrickBox box = boxOf(brick, grid);
    const Shift shift = shiftOver(vec2(lensBox), vec2(lensBox.z, lensBox.w), brick.slopeMin, brick.slopeMax);
    return tilesOver(box.low + shift.low - ownMarginPx, box.high + shift.high + ownMarginPx, outputs);
}

/// The same for lens positions of `lensBox` and times of `times`, where what the brick holds moves. Where it
/// is seen goes evenly, or at least always the same way, with each of lens position, slope, depth rate and
/// time; so the farthest lie at their ends.
KERNEL ivec4 tilesSeeingMoving(IN(Brick) brick, IN(BrickMotion) motion, IN(GridLayout) grid,
                               IN(OutputLayout) outputs, vec4 lensBox, vec2 times, float c2, float marginPx) {
    if (keepsStill(motion)) return tilesSeeing(brick, grid, outputs, lensBox, marginPx);
    const BrickBox box = boxOf(brick, grid);
    vec2 low = vec2(kInfinity), high = vec2(-kInfinity);
    for (int corner = 0; corner < 16; ++corner) {
        const float time = (corner & 1) != 0 ? times.y : times.x;
        const float depth = 1.0f + time * ((corner & 2) != 0 ? motion.depthRate.y : motion.depthRate.x);
        const vec2 uv = (corner & 4) != 0 ? vec2(lensBox.z, lensBox.w) : vec2(lensBox);
        const float lean = ((corner & 8) != 0 ? brick.slopeMax : brick.slopeMin) - c2;
        const vec2 a = time * motion.low, b = time * motion.high, far = motion.center + c2 * uv;
        low = min(low, far + (box.low - motion.center + min(a, b) + lean * uv) / depth);
        high = max(high, far + (box.high - motion.center + max(a, b) + lean * uv) / depth);
    }
    const float ownMarginPx = min(marginPx, max(marginPx * widestRadius(brick), kMinMarginPx));
    return tilesOver(low - ownMarginPx, high + ownMarginPx, outputs);
}

SLANT_SHARED_END
#endif

// Which tiles can see a brick through a lens of many surfaces. As host/reconstruct/lens_tiles.cpp, where it is
// explained; the bounds are lensTileBoundAt(int), to be declared before the include.
#ifndef SLANT_LIB_LENS_TILES_GLSL
#define SLANT_LIB_LENS_TILES_GLSL
#include "lib/grid.glsl"

/// Bounds of a group, interpolated at the ends of a brick's slopes.
struct BoundsAt {
    int first, last;      // blocks of the slopes below
    float part, lastPart; // towards the next ones
    int step_;            // from a slope to the next
};

float boundAt(int begin, int step_, float t, int i) {
    const float a = lensTileBoundAt(begin + i);
    return a + t * (lensTileBoundAt(begin + step_ + i) - a);
}
float lowBound(BoundsAt at, int i) {
    return min(boundAt(at.first, at.step_, at.part, i), boundAt(at.last, at.step_, at.lastPart, i));
}
float highBound(BoundsAt at, int i) {
    return max(boundAt(at.first, at.step_, at.part, i), boundAt(at.last, at.step_, at.lastPart, i));
}

/// The tiles [x, y) of `count` whose bounds, from `offset` on, meet [from, to].
ivec2 meeting(BoundsAt at, int offset, int count, float from, float to) {
    ivec2 range = ivec2(0);
    for (int end = count; range.x < end;) {
        const int middle = (range.x + end) / 2;
        if (highBound(at, offset + count + middle) >= from)
            end = middle;
        else
            range.x = middle + 1;
    }
    for (int end = count; range.y < end;) {
        const int middle = (range.y + end) / 2;
        if (lowBound(at, offset + middle) > to)
            end = middle;
        else
            range.y = middle + 1;
    }
    return range;
}

/// As tilesSeeing of lib/grid.glsl.
ivec4 tilesOfCompoundLens(Brick brick, GridLayout grid, OutputLayout outputs, int group) {
    const float steps = float(kLensTileSlopes - 1) * grid.invBucket / float(grid.bucketCount);
    const float from = (brick.slopeMin - grid.slopeMin) * steps, to = (brick.slopeMax - grid.slopeMin) * steps;
    if (!(from > -0.01 && to < float(kLensTileSlopes - 1) + 0.01)) return ivec4(0, 0, outputs.tileCount);
    const ivec2 tiles = outputs.tileCount;
    const int step_ = 2 * (tiles.x + tiles.y), begin = group * kLensTileSlopes * step_;
    const int first = clamp(int(from), 0, kLensTileSlopes - 2), last = clamp(int(to), 0, kLensTileSlopes - 2);
    const BoundsAt at = BoundsAt(begin + first * step_, begin + last * step_, from - float(first), to - float(last), step_);
    const vec4 box = boxOf(brick, grid);
    const ivec2 columns = meeting(at, 0, tiles.x, box.x, box.z);
    const ivec2 rows = meeting(at, 2 * tiles.x, tiles.y, box.y, box.w);
    return ivec4(columns.x, rows.x, columns.y, rows.y);
}
#endif

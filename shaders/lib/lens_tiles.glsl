// Which tiles can see a brick through a compound lens, which host/reconstruct/lens_tiles.h explains.
//
// Needs, declared before the include: lensTileBoundAt(int), which reads the bounds. In C++ it is included in
// a struct that has that, after lib/grid.glsl.
#include "lib/grid.glsl"

/// Bounds of a group, interpolated at the ends of a brick's slopes.
struct BoundsAt {
    int first, last;      // blocks of the slopes below
    float part, lastPart; // towards the next ones
    int step_;            // from a slope to the next
};

KERNEL float boundAt(int begin, int step_, float t, int i) {
    const float a = lensTileBoundAt(begin + i);
    return a + t * (lensTileBoundAt(begin + step_ + i) - a);
}
KERNEL float lowBound(IN(BoundsAt) at, int i) {
    return min(boundAt(at.first, at.step_, at.part, i), boundAt(at.last, at.step_, at.lastPart, i));
}
KERNEL float highBound(IN(BoundsAt) at, int i) {
    return max(boundAt(at.first, at.step_, at.part, i), boundAt(at.last, at.step_, at.lastPart, i));
}

/// The tiles [x, y) of `count` whose bounds, from `offset` on, meet [from, to].
KERNEL ivec2 meeting(IN(BoundsAt) at, int offset, int count, float from, float to) {
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

/// Like tilesSeeing of lib/grid.glsl, and more of them; `group` counts from the first of the bounds.
KERNEL ivec4 tilesOfCompoundLens(IN(SweptBrick) brick, IN(GridLayout) grid, IN(OutputLayout) outputs,
                                 int group) {
    const float steps = float(kLensTileSlopes - 1) * grid.invBucket / float(grid.bucketCount);
    const float from = (brick.slopeMin - grid.slopeMin) * steps,
                to = (brick.slopeMax - grid.slopeMin) * steps;
    // There are no bounds beyond the slopes of the grid.
    if (!(from > -0.01f && to < float(kLensTileSlopes - 1) + 0.01f)) return ivec4(0, 0, outputs.tileCount);
    const ivec2 tiles = outputs.tileCount;
    const int step_ = 2 * (tiles.x + tiles.y), begin = group * kLensTileSlopes * step_;
    const int first = clamp(int(from), 0, kLensTileSlopes - 2), last = clamp(int(to), 0, kLensTileSlopes - 2);
    const BoundsAt at = {begin + first * step_, begin + last * step_, from - float(first), to - float(last),
                         step_};
    const ivec2 columns = meeting(at, 0, tiles.x, brick.box.low.x, brick.box.high.x);
    const ivec2 rows = meeting(at, 2 * tiles.x, tiles.y, brick.box.low.y, brick.box.high.y);
    return ivec4(columns.x, rows.x, columns.y, rows.y);
}

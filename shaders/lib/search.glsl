// One output against the bins. As host/reconstruct/search.cpp, where it is explained.
//
// Needs, declared before the include: positionAt(uint), valueAt(uint) and cellStartAt(uint), which read the
// bins;
// listedBrick(uint) and listedCellBase(uint), which read the lists; a struct Sweep with a member `bool running`;
// visit(Candidate, inout Sweep), called for each candidate until it clears `running`; and hides(Sweep, Brick),
// whether what was met so far hides a brick and all that follow.
#ifndef SLANT_LIB_SEARCH_GLSL
#define SLANT_LIB_SEARCH_GLSL
#include "lib/grid.glsl"
#include "lib/output.glsl"

/// False where the search would have passed kMaxLoopIterations: the output must be done elsewhere.
bool forEachCandidate(GridLayout grid, Output o, float radius, float maxRadiusRatio, uint listBegin, uint listEnd, inout Sweep sweep) {
    const int side = grid.cellsPerBrick;
    // In cells: where the output lies, how far its window moves with slope, and its half width.
    const vec2 center = (o.xy - grid.origin) * grid.invCell, shear = o.uv * grid.invCell;
    int iterations = 0;
    for (uint entry = listBegin; entry < listEnd && sweep.running; ++entry) {
        const Brick brick = listedBrick(entry);
        const float ownRadius = radius * max(widestRadius(brick), 1.0 / maxRadiusRatio);
        const vec2 reach = ownRadius * grid.invCell * o.extent;
        const vec2 a = brick.slopeMin * shear, b = brick.slopeMax * shear;
        const ivec2 first = max(cellAt(grid, center - max(a, b) - reach), firstCell(brick));
        const ivec2 last = min(cellAt(grid, center - min(a, b) + reach), lastCell(brick));
        ++iterations;
        if (iterations > kMaxLoopIterations) return false;
        if (hides(sweep, brick)) return true;
        if (first.x > last.x || first.y > last.y) continue;
        const uint cellBase = listedCellBase(entry);
        for (int row = first.y; row <= last.y && sweep.running; ++row) {
            const uint cell = cellBase + uint(row * side);
            const uint begin = cellStartAt(cell + uint(first.x));
            const uint end = cellStartAt(cell + uint(last.x) + 1u);
            iterations += int(end - begin) + 1;
            if (iterations > kMaxLoopIterations) return false;
            for (uint record = begin; record < end && sweep.running; ++record) {
                const vec4 position = positionAt(record);
                vec2 offset = position.xy + position.z * o.uv - o.xy;
                if (kCompoundLens) offset = onFilm(o, offset);
                const float distance2 = offset.x * offset.x + offset.y * offset.y;
                if (!(distance2 < ownRadius * ownRadius)) continue;
                const vec4 value = valueAt(record);
                const float radiusRatio = min(value.w, maxRadiusRatio);
                const float scaled2 = distance2 * (radiusRatio * radiusRatio);
                if (scaled2 < radius * radius)
                    visit(Candidate(offset, scaled2, position.z, position.w, value), sweep);
            }
        }
    }
    return true;
}
#endif

// One output against the bins. As host/reconstruct/search.cpp, where it is explained.
//
// Needs, declared before the include: positionAt(uint), cellStartAt(uint), brickAt(uint), listedBrick(uint),
// which read the bins; a struct Sweep with a member `bool running`; and visit(Candidate, inout Sweep), called
// for each candidate until it clears `running`.
#ifndef SLANT_LIB_SEARCH_GLSL
#define SLANT_LIB_SEARCH_GLSL
#include "lib/grid.glsl"
#include "lib/output_pattern.glsl"

/// False where the search would have passed kMaxLoopIterations: the output must be done elsewhere.
bool forEachCandidate(GridLayout grid, Output o, float radius, uint listBegin, uint listEnd, inout Sweep sweep) {
    const int side = grid.cellsPerBrick;
    int iterations = 0;
    for (uint entry = listBegin; entry < listEnd && sweep.running; ++entry) {
        const uint id = listedBrick(entry);
        const Brick brick = brickAt(id);
        const vec2 a = brick.slopeMin * o.uv, b = brick.slopeMax * o.uv;
        const vec2 low = (o.xy - max(a, b) - radius - grid.origin) * grid.invCell;
        const vec2 high = (o.xy - min(a, b) + radius - grid.origin) * grid.invCell;
        const ivec4 box = boxOf(brick, grid);
        const ivec2 first = max(cellAt(grid, low), box.xy), last = min(cellAt(grid, high), box.zw);
        ++iterations;
        if (iterations > kMaxLoopIterations) return false;
        if (first.x > last.x) continue;
        const ivec2 corner = cornerOf(brick, grid);
        for (int row = first.y; row <= last.y && sweep.running; ++row) {
            const uint cell = (id * uint(side) + uint(row - corner.y)) * uint(side) - uint(corner.x);
            const uint begin = cellStartAt(cell + uint(first.x));
            const uint end = cellStartAt(cell + uint(last.x) + 1u);
            iterations += int(end - begin) + 1;
            if (iterations > kMaxLoopIterations) return false;
            for (uint record = begin; record < end && sweep.running; ++record) {
                const vec4 position = positionAt(record);
                const vec2 offset = position.xy + position.z * o.uv - o.xy;
                const float distance2 = offset.x * offset.x + offset.y * offset.y;
                if (distance2 < radius * radius) visit(Candidate(offset, distance2, position.z, record), sweep);
            }
        }
    }
    return true;
}
#endif

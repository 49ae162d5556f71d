// The samples around an output, brick by brick: what every search of the bins is made of.
//
// Needs, declared before the include: positionAt(uint), valueAt(uint) and cellStartAt(uint), which read the
// bins; listedBrick(uint) and listedCellBase(uint), which read the lists; kMoving, whether anything moves,
// and then motionAt(uint), listedMotion(uint) and motionLayout; kMaxSteps, after which a search stops; a
// struct Sweep with a member `bool running`; visit(Candidate, inout Sweep), called for each candidate until
// it clears `running`; and hides(Sweep, Brick), whether the samples visited so far hide a brick and all later
// ones. In C++ it is included in a struct that has these, after lib/candidate.glsl, lib/grid.glsl and
// lib/output.glsl.
#include "lib/candidate.glsl"
#include "lib/grid.glsl"
#include "lib/output.glsl"

/// Visits the samples that reproject to within `radius` of the output, or less for those whose own radius is
/// less than R: down to 1 / maxRadiusRatio of it. They come in the order of their bricks: front to back, up
/// to the width of a bucket. Returns the number of loop steps: if it is above kMaxSteps, the search stopped
/// early and the output must be done elsewhere.
KERNEL int forEachCandidate(IN(GridLayout) grid, IN(Output) o, float radius, float maxRadiusRatio,
                            uint listBegin, uint listEnd, INOUT(Sweep) sweep) {
    const int side = grid.cellsPerBrick;
    // In cells: where the output lies, how far its window moves with slope, and its half width.
    const vec2 center = (o.xy - grid.origin) * grid.invCell, shear = o.uv * grid.invCell;
    const float time = o.t - 0.5f;
    int steps = 0;
    for (uint entry = listBegin; entry < listEnd && sweep.running; ++entry) {
        Brick brick = listedBrick(entry);
        const float ownRadius = radius * max(widestRadius(brick), 1.0f / maxRadiusRatio);
        vec2 reach = ownRadius * grid.invCell * o.extent;
        Shift shift = shiftAt(shear, brick.slopeMin, brick.slopeMax);
        bool moves = false;
        if (kMoving) {
            IN(BrickMotion) motion = listedMotion(entry);
            moves = !keepsStill(motion);
            if (moves) {
                const Shift back = shiftBack(motion, o.xy, o.uv, time, motionLayout.c2);
                shift.low -= grid.invCell * back.high;
                shift.high -= grid.invCell * back.low;
                reach *= widestDepthAt(motion, time);
                brick.slopeMin = leastSlopeAt(motion, brick.slopeMin, time, motionLayout.c2);
            }
        }
        const ivec2 first = max(cellAt(grid, center - shift.high - reach), firstCell(brick));
        const ivec2 last = min(cellAt(grid, center - shift.low + reach), lastCell(brick));
        ++steps;
        if (steps > kMaxSteps) return steps;
        if (hides(sweep, brick)) return steps;
        if (first.x > last.x || first.y > last.y) continue;
        const uint cellBase = listedCellBase(entry);
        for (int row = first.y; row <= last.y && sweep.running; ++row) {
            const uint cell = cellBase + uint(row * side);
            const uint begin = cellStartAt(cell + uint(first.x));
            const uint end = cellStartAt(cell + uint(last.x) + 1u);
            steps += int(end - begin) + 1;
            if (steps > kMaxSteps) return steps;
            for (uint record = begin; record < end && sweep.running; ++record) {
                IN(vec4) position = positionAt(record);
                Trajectory trajectory = {vec2(position), position.z};
                vec3 moving = vec3(0.0f);
                if (moves) {
                    const Motion motion = motionOf(motionAt(record));
                    trajectory = atTime(trajectory, motion, time);
                    moving = vec3(motion.velocity, motion.depthRate);
                }
                vec2 offset = seenFrom(trajectory, o.uv) - o.xy;
                if (o.onSceneSide) offset = onFilm(o, offset);
                const float distance2 = offset.x * offset.x + offset.y * offset.y;
                if (!(distance2 < ownRadius * ownRadius)) continue;
                IN(vec4) value = valueAt(record);
                const float radiusRatio = min(value.w, maxRadiusRatio);
                const float scaled2 = distance2 * (radiusRatio * radiusRatio);
                if (!(scaled2 < radius * radius)) continue;
                const Candidate candidate = {offset, scaled2, trajectory.slope, position.w, value, moving};
                visit(candidate, sweep);
            }
        }
    }
    return steps;
}

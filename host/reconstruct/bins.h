// Stage "bin": the input samples in cell order. The compute path makes the same words.
#pragma once
#include "reconstruct/motion_grid.h"

#include <vector>

namespace slant {

struct Bins {
    GridLayout grid{};
    std::vector<Brick> bricks;   ///< occupied bricks, ascending in (layer, row, column)
    std::vector<uint> cellStart; ///< bricks * cellsPerBrick^2 + 1: first record of each cell
    std::vector<vec4> positions; ///< records in cell order, in sample order within a cell: p.x, p.y, slope,
                                 ///< visibilityWeight
    std::vector<vec4> values;    ///< r, g, b of the plane that was taken last (0 before), radiusRatioAt
    std::vector<uint> samples;   ///< of each record: its index in the field

    // Where things move; else empty.
    MotionGrid motion;
    std::vector<vec4> motions; ///< of each record: Motion of lib/motion.glsl
    std::vector<BrickMotion> brickMotions;
    std::vector<vec2> brickRanks; ///< in the middle of its ranks and depth rates, to put bricks front to back
};

/// Without values.
Bins binSamples(const SceneSideSamples& samples, const BinScope& scope);

void takeValues(Bins& bins, const SceneSideSamples& samples, ValuePlane plane);

/// The values of records, put in the order of `count` samples; 0 for a sample that has no record.
std::vector<vec3> valuesOfSamples(std::span<const uint> samples, std::span<const vec4> values,
                                  std::size_t count);

} // namespace slant

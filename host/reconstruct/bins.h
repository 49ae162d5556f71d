// Stage "bin": the input samples in cell order. The compute path makes the same words.
#pragma once
#include "reconstruct/grid.h"

#include <vector>

namespace slant {

struct Bins {
    GridLayout grid{};
    std::vector<Brick> bricks;   ///< occupied bricks, ascending in (bucket, row, column)
    std::vector<uint> cellStart; ///< bricks * cellsPerBrick^2 + 1: first record of each cell
    std::vector<vec4> positions; ///< records in cell order, in sample order within a cell: p.x, p.y, slope,
                                 ///< visibilityWeight
    std::vector<vec4> radiances; ///< r, g, b, radiusRatioAt
    std::vector<uint> samples;   ///< of each record: its index in the field
};

Bins binSamples(const LightField& field, const BinScope& scope);

} // namespace slant

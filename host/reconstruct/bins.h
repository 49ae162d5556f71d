// Stage "bin": the input samples in cell order. The compute path makes the same words.
#pragma once
#include "reconstruct/grid.h"

#include <vector>

namespace slant {

/// Occupied cells of a brick, in cells from the grid's origin; inclusive.
struct CellBox {
    ivec2 first, last;
};

inline ivec2 cornerOf(const Brick& brick, const GridLayout& grid) {
    return grid.cellsPerBrick * ivec2(brick.place & 0xffffu, brick.place >> 16);
}

inline CellBox boxOf(const Brick& brick, const GridLayout& grid) {
    const ivec2 corner = cornerOf(brick, grid);
    return {corner + ivec2(brick.box & 0xffu, brick.box >> 8 & 0xffu),
            corner + ivec2(brick.box >> 16 & 0xffu, brick.box >> 24)};
}

struct Bins {
    GridLayout grid{};
    std::vector<Brick> bricks;   ///< occupied bricks, ascending in (bucket, row, column)
    std::vector<uint> cellStart; ///< bricks * cellsPerBrick^2 + 1: first record of each cell
    std::vector<vec4> positions; ///< records in cell order, in sample order within a cell: p.x, p.y, slope, 0
    std::vector<vec4> radiances; ///< r, g, b, alpha
};

/// Bins the samples that reach `region` (see chooseGrid).
Bins binSamples(const LightField& field, const Rect& region, float marginPx);

} // namespace slant

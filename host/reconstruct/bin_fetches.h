// What lib/search.glsl fetches, on the CPU: the base of the structs that include it. For source files only.
#pragma once
#include "reconstruct/candidates.h"
#include "reconstruct/kernels.h"

#include <limits>

namespace slant {

struct BinFetches {
    const SearchContext& context;

    /// The CPU has no limit.
    static constexpr int kMaxSteps = std::numeric_limits<int>::max();

    const vec4& positionAt(uint record) const { return context.bins.positions[record]; }
    const vec4& valueAt(uint record) const { return context.bins.values[record]; }
    uint cellStartAt(uint cell) const { return context.bins.cellStart[cell]; }
    const Brick& listedBrick(uint entry) const { return context.bins.bricks[context.bricks[entry]]; }
    /// Where in cellStart the brick's cell at the grid's origin would stand, modulo 2^32.
    uint listedCellBase(uint entry) const {
        const uint id = context.bricks[entry], side = uint(context.bins.grid.cellsPerBrick);
        const uvec2 corner = uvec2(firstCell(context.bins.bricks[id])) / side * side;
        return (id * side - corner.y) * side - corner.x;
    }
    uint listLength() const { return uint(context.bricks.size()); }
};

} // namespace slant

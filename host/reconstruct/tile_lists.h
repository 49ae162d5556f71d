// Stage "lists": which bricks each tile of outputs has to look at, through each group of lens positions.
#pragma once
#include "reconstruct/bins.h"
#include "reconstruct/output_pattern.h"

#include <functional>
#include <span>
#include <vector>

namespace slant {

/// Lists for the groups [firstGroup, firstGroup + groupCount): list (group - firstGroup) * tiles + tile holds
/// bricks[start[list], start[list + 1]), ascending.
struct TileLists {
    std::vector<uint> start;
    std::vector<uint> bricks;
};

/// Tiles whose outputs, through the lens positions of `box`, can see a sample of `brick` within marginPx:
/// half-open, in tiles, clipped to the layout; empty where last <= first.
struct TileRange {
    ivec2 first, last;
    bool empty() const { return last.x <= first.x || last.y <= first.y; }
};
TileRange tilesSeeing(const Brick& brick, const GridLayout& grid, const OutputLayout& layout,
                      const LensBox& box, float marginPx);

TileLists makeTileLists(const Bins& bins, const OutputLayout& layout, std::span<const LensBox> groups,
                        float marginPx);

/// The same, if tiles see a brick through a group in another way.
using TilesOfBrick = std::function<TileRange(const Brick& brick, std::size_t group)>;
TileLists makeTileLists(const Bins& bins, const OutputLayout& layout, std::size_t groups,
                        const TilesOfBrick& tilesOf);

} // namespace slant

// Stage "lists": which bricks each tile of outputs has to look at, through each group of lens positions.
#pragma once
#include "reconstruct/bins.h"
#include "reconstruct/output_pattern.h"

#include <functional>
#include <span>
#include <vector>

namespace slant {

/// Lists for the groups [firstGroup, firstGroup + groupCount): list (group - firstGroup) * tiles + tile holds
/// bricks[start[list], start[list + 1]), front to back.
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
/// The same for brick `brick` of bins that move, from the first to the last of `times`.
TileRange tilesSeeing(const Bins& bins, uint brick, const OutputLayout& layout, const LensBox& box,
                      vec2 times, float marginPx);

/// The bricks as an output finds them: their numbers in `Bins`, front to back at each slot of time.
class BrickOrders {
public:
    /// Nothing moves: bricks stand front to back as they are.
    BrickOrders() = default;
    /// From Bins::brickRanks, at the middle of each slot, counted from that of the shutter.
    BrickOrders(const MotionGrid& motion, std::span<const vec2> brickRanks, std::span<const float> slotTimes);

    uint at(std::size_t slot, std::size_t rank) const {
        return orders_.empty() ? uint(rank) : orders_[storedAt(slot)][rank];
    }
    /// Which of `all` a slot has.
    std::size_t storedAt(std::size_t slot) const { return orders_.size() > 1 ? slot : 0; }
    const std::vector<std::vector<uint>>& all() const { return orders_; }

private:
    std::vector<std::vector<uint>> orders_; ///< one if nothing changes its depth
};

/// Where nothing moves.
TileLists makeTileLists(const Bins& bins, const OutputLayout& layout, std::span<const LensBox> groups,
                        float marginPx);

/// How groups see bricks, counted from the first group of the lists.
struct GroupSight {
    std::function<TileRange(uint brick, std::size_t group)> tilesOf;
    std::function<uint(std::size_t group, std::size_t rank)> brickAt; ///< front to back; unset: as they are
    /// Unset: the tiles all do.
    std::function<bool(uint brick, std::size_t group, std::size_t list)> sees = {};
};
TileLists makeTileLists(const Bins& bins, const OutputLayout& layout, std::size_t groups,
                        const GroupSight& sight);

} // namespace slant

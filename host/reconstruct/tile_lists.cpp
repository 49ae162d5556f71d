#include "reconstruct/tile_lists.h"

#include "base/parallel.h"
#include "reconstruct/kernels.h"

#include <algorithm>
#include <numeric>

namespace slant {
TileRange tilesSeeing(const Brick& brick, const GridLayout& grid, const OutputLayout& layout,
                      const LensBox& box, float marginPx) {
    const ivec4 tiles = tilesSeeing(brick, grid, layout, vec4(box.min, box.max), marginPx);
    return {ivec2(tiles.x, tiles.y), ivec2(tiles.z, tiles.w)};
}

TileRange tilesSeeing(const Bins& bins, uint brick, const OutputLayout& layout, const LensBox& box,
                      vec2 times, float marginPx) {
    const ivec4 tiles = tilesSeeingMoving(bins.bricks[brick], bins.brickMotions[brick], bins.grid, layout,
                                          vec4(box.min, box.max), times, bins.motion.layout.c2, marginPx);
    return {ivec2(tiles.x, tiles.y), ivec2(tiles.z, tiles.w)};
}

BrickOrders::BrickOrders(const MotionGrid& motion, std::span<const vec2> brickRanks,
                         std::span<const float> slotTimes) {
    if (!motion.moves()) return;
    orders_.resize(motion.changesDepth ? slotTimes.size() : 1);
    parallelFor(0, orders_.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t slot = first; slot < last; ++slot) {
            std::vector<uint>& order = orders_[slot];
            order.resize(brickRanks.size());
            std::iota(order.begin(), order.end(), 0u);
            std::ranges::stable_sort(order, {}, [&](uint brick) {
                return rankAt(brickRanks[brick].x, brickRanks[brick].y, slotTimes[slot]);
            });
        }
    });
}

TileLists makeTileLists(const Bins& bins, const OutputLayout& layout, std::span<const LensBox> groups,
                        float marginPx) {
    const auto tilesOf = [&](uint brick, std::size_t group) {
        return tilesSeeing(bins.bricks[brick], bins.grid, layout, groups[group], marginPx);
    };
    return makeTileLists(bins, layout, groups.size(), {tilesOf, {}});
}

TileLists makeTileLists(const Bins& bins, const OutputLayout& layout, std::size_t groups,
                        const GroupSight& sight) {
    const std::size_t tiles = std::size_t(layout.tileCount.x) * layout.tileCount.y;
    TileLists lists;
    lists.start.assign(groups * tiles + 1, 0);
    const auto forEachEntry = [&](std::size_t group, auto&& visit) {
        for (std::size_t rank = 0; rank < bins.bricks.size(); ++rank) {
            const uint brick = sight.brickAt ? sight.brickAt(group, rank) : uint(rank);
            const TileRange range = sight.tilesOf(brick, group);
            for (int y = range.first.y; y < range.last.y; ++y)
                for (int x = range.first.x; x < range.last.x; ++x) {
                    const std::size_t list = group * tiles + std::size_t(y) * layout.tileCount.x + x;
                    if (!sight.sees || sight.sees(brick, group, list)) visit(list, brick);
                }
        }
    };
    parallelFor(0, groups, 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t group = first; group < last; ++group)
            forEachEntry(group, [&](std::size_t list, uint) { ++lists.start[list + 1]; });
    });
    for (std::size_t list = 1; list < lists.start.size(); ++list) lists.start[list] += lists.start[list - 1];

    lists.bricks.resize(lists.start.back());
    std::vector<uint> next(lists.start.begin(), lists.start.end() - 1);
    parallelFor(0, groups, 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t group = first; group < last; ++group)
            forEachEntry(group, [&](std::size_t list, uint brick) { lists.bricks[next[list]++] = brick; });
    });
    return lists;
}

} // namespace slant

#include "reconstruct/tile_lists.h"

#include "base/parallel.h"
#include "reconstruct/kernels.h"

namespace slant {
TileRange tilesSeeing(const Brick& brick, const GridLayout& grid, const OutputLayout& layout,
                      const LensBox& box, float marginPx) {
    const ivec4 tiles = tilesSeeing(brick, grid, layout, vec4(box.min, box.max), marginPx);
    return {ivec2(tiles.x, tiles.y), ivec2(tiles.z, tiles.w)};
}

TileLists makeTileLists(const Bins& bins, const OutputLayout& layout, std::span<const LensBox> groups,
                        float marginPx) {
    return makeTileLists(bins, layout, groups.size(), [&](const Brick& brick, std::size_t group) {
        return tilesSeeing(brick, bins.grid, layout, groups[group], marginPx);
    });
}

TileLists makeTileLists(const Bins& bins, const OutputLayout& layout, std::size_t groups,
                        const TilesOfBrick& tilesOf) {
    const std::size_t tiles = std::size_t(layout.tileCount.x) * layout.tileCount.y;
    TileLists lists;
    lists.start.assign(groups * tiles + 1, 0);
    const auto forEachEntry = [&](std::size_t group, auto&& visit) {
        for (std::size_t brick = 0; brick < bins.bricks.size(); ++brick) {
            const TileRange range = tilesOf(bins.bricks[brick], group);
            for (int y = range.first.y; y < range.last.y; ++y)
                for (int x = range.first.x; x < range.last.x; ++x)
                    visit(group * tiles + std::size_t(y) * layout.tileCount.x + x, uint(brick));
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

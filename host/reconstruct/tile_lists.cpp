#include "reconstruct/tile_lists.h"

#include "base/parallel.h"

namespace slant {
namespace {

int tileOf(float px) {
    return int(glm::floor(glm::clamp(px * (1.f / float(kTileSize)), -1e6f, 1e6f)));
}

} // namespace

BrickBox boxOf(const Brick& brick, const GridLayout& grid) {
    const float cellPx = 1.f / grid.invCell;
    const ivec2 first = firstCell(brick), last = lastCell(brick);
    const ivec2 rim = grid.brickCount * grid.cellsPerBrick - 1;
    BrickBox box{grid.origin + vec2(first) * cellPx, grid.origin + vec2(last + 1) * cellPx};
    if (first.x == 0) box.low.x = -kFarPx;
    if (first.y == 0) box.low.y = -kFarPx;
    if (last.x == rim.x) box.high.x = kFarPx;
    if (last.y == rim.y) box.high.y = kFarPx;
    return box;
}

TileRange tilesSeeing(const Brick& brick, const GridLayout& grid, const OutputLayout& layout,
                      const LensBox& box, float marginPx) {
    const float ownMarginPx = glm::min(marginPx, glm::max(marginPx * widestRadius(brick), kMinMarginPx));
    const auto [low, high] = boxOf(brick, grid);
    const vec2 a = brick.slopeMin * box.min, b = brick.slopeMin * box.max;
    const vec2 c = brick.slopeMax * box.min, d = brick.slopeMax * box.max;
    const vec2 shearMin = glm::min(glm::min(a, b), glm::min(c, d));
    const vec2 shearMax = glm::max(glm::max(a, b), glm::max(c, d));
    const vec2 from = low + shearMin - ownMarginPx - vec2(layout.regionOrigin);
    const vec2 to = high + shearMax + ownMarginPx - vec2(layout.regionOrigin);
    return {glm::max(ivec2(tileOf(from.x), tileOf(from.y)), ivec2(0)),
            glm::min(ivec2(tileOf(to.x), tileOf(to.y)) + 1, layout.tileCount)};
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

#include "reconstruct/list_work.h"

#include "shared/layer_map.h"

#include <bit>

namespace slant {

std::uint64_t tilePixels(ivec2 size) {
    std::uint64_t bits = 0;
    for (int y = 0; y < glm::min(size.y, kTileSize); ++y)
        for (int x = 0; x < glm::min(size.x, kTileSize); ++x) bits |= 1ull << tileBit({x, y});
    return bits;
}

ListWork listWork(const ListClasses& classes, const Chunk& chunk, const OutputPattern& pattern) {
    const ivec2 tiles = chunk.layout.tileCount;
    const uint tilesPerGroup = uint(tiles.x) * uint(tiles.y);
    ListWork work;
    work.missed.reserve(classes.codes.size());
    for (uint list = 0; list < classes.codes.size(); ++list) {
        const uint tile = list % tilesPerGroup;
        const ListItem item{tile % uint(tiles.x), tile / uint(tiles.x), list / tilesPerGroup, list};
        const std::uint64_t inside =
            tilePixels(chunk.layout.regionSize - kTileSize * ivec2(item.tileX, item.tileY));
        const std::uint64_t missed = inside & classes.missedOf(list);
        const bool sparse = (classes.codes[list] & kSparseBit) != 0;
        const int bits = sparse ? pattern.sparseBits : pattern.groupBits;
        work.outputs += std::uint64_t(std::popcount(inside)) << bits;
        work.fromMap += std::uint64_t(std::popcount(inside & ~missed)) << bits;
        work.missed.push_back(missed);
        if (missed != 0) (sparse ? work.sparse : work.whole).push_back(item);
    }
    return work;
}

void addMapShare(std::vector<float>& share, const Rect& frame, const Band& band, const ListClasses& classes,
                 std::size_t groups) {
    share.resize(frame.area());
    const std::size_t columns = std::size_t(band.region.width() + kTileSize - 1) / kTileSize;
    const std::size_t tiles = columns * (std::size_t(band.region.height() + kTileSize - 1) / kTileSize);
    for (int y = band.y0; y < band.y1; ++y)
        for (int x = frame.x0; x < frame.x1; ++x) {
            const ivec2 position(x - band.region.x0, y - band.region.y0);
            const std::size_t tile = std::size_t(position.y / kTileSize) * columns + position.x / kTileSize;
            float& sum = share[std::size_t(y - frame.y0) * frame.width() + (x - frame.x0)];
            for (std::size_t list = tile; list < classes.codes.size(); list += tiles)
                if ((classes.missedOf(list) >> tileBit(position) & 1) == 0)
                    sum += ((classes.codes[list] & kInFocusBit) != 0 ? 0.5f : 1.f) / float(groups);
        }
}

} // namespace slant

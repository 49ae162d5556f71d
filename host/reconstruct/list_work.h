// How the lists of a chunk are served: the class of each list, what the layer map leaves of it, and so what
// must be searched for in the bins.
#pragma once
#include "reconstruct/plan.h"

#include <cstdint>
#include <vector>

namespace slant {

struct ListClasses {
    std::vector<uint> codes;  ///< of each list: clusters, kInFocusBit, kSparseBit (ListClass::code)
    std::vector<uint> missed; ///< two per list: see missedOf

    /// Nothing comes from a map; all is searched for.
    explicit ListClasses(std::size_t lists) : codes(lists, 0), missed(2 * lists, ~0u) {}
    void set(std::size_t list, uint code, std::uint64_t missedPixels) {
        codes[list] = code;
        missed[2 * list] = uint(missedPixels);
        missed[2 * list + 1] = uint(missedPixels >> 32);
    }
    /// The pixels of a list's tile that the map does not serve, bit tileBit each.
    std::uint64_t missedOf(std::size_t list) const {
        return missed[2 * list] | std::uint64_t(missed[2 * list + 1]) << 32;
    }
};

/// The bit of a position in a region whose tiles begin at its corner.
inline int tileBit(ivec2 position) {
    return position.y % kTileSize * kTileSize + position.x % kTileSize;
}
/// The bits of the pixels of a tile of which `size` lie in the region; more than kTileSize count as that.
std::uint64_t tilePixels(ivec2 size);

/// A list whose missed pixels must be searched for.
struct ListItem {
    uint tileX, tileY;
    uint group; ///< of the chunk
    uint list;
};

struct ListWork {
    std::vector<ListItem> whole;            ///< all outputs of a group
    std::vector<ListItem> sparse;           ///< those that stand for the others
    std::vector<std::uint64_t> missed;      ///< of each list of the chunk, the pixels in the region
    std::uint64_t outputs = 0, fromMap = 0; ///< that are made, and of them from the map
};
ListWork listWork(const ListClasses& classes, const Chunk& chunk, const OutputPattern& pattern);

/// Adds to `share`, for the pixels of `frame` that a band finishes, the part of a chunk's lists: 1 for a list
/// that the map serves there, 1/2 if it is in focus, divided by the number `groups` of all.
void addMapShare(std::vector<float>& share, const Rect& frame, const Band& band, const ListClasses& classes,
                 std::size_t groups);

} // namespace slant

// Outputs from the layer map: which lists of outputs can be taken from it, and how.
//
// A list (a tile of pixels, a group of lens positions) sees clusters of surfaces, with gaps in slope between
// them. Where each of them moves by a few pixels only from its nearest to its farthest part, an output looks
// its way through them front to back: in each it follows its ray to where the map has a layer of that slope,
// and composites what it finds. Its lens positions are the same in every pixel, and so free of noise; what is
// in focus is looked up at the outputs' own places in the pixel, the rest at its middle.
#pragma once
#include "reconstruct/layer_map.h"
#include "reconstruct/output_pattern.h"
#include "reconstruct/plan.h"

#include <optional>

namespace slant {

/// Whether a method takes outputs of the field from a layer map. Through a lens of many surfaces it does not:
/// there every output has its own metric and its own part of a distorted picture.
inline bool usesLayers(const LightField& field, Method method) {
    return method == Method::automatic && field.lensMap.empty();
}

struct ListClass {
    std::vector<Cluster> clusters; ///< front to back; empty where outputs have to be searched for in the bins
    bool inFocus = false; ///< one of them is in focus: each output counts at its own place in the pixel
    bool sparse = false;  ///< a few outputs are enough, wherever they come from

    /// As in the buffer of classes, see kInFocusBit and kSparseBit.
    uint code() const {
        return uint(clusters.size()) | (inFocus && !clusters.empty() ? kInFocusBit : 0) |
               (sparse ? kSparseBit : 0);
    }
};

/// How the outputs of a list are made that look through `lens`, a part of the disc of radius `lensScale`.
ListClass classOfList(const Bins& bins, std::span<const uint> bricks, const LensBox& lens, float lensScale,
                      const MapLayout& map);

/// How the lists of a chunk are made.
struct ListClasses {
    std::vector<uint> codes;  ///< of each list, see ListClass::code
    std::vector<uint> missed; ///< two a list: see missedOf

    explicit ListClasses(std::size_t lists) : codes(lists, 0), missed(2 * lists, ~0u) {}
    void set(std::size_t list, const ListClass& listClass, std::uint64_t missedPixels) {
        codes[list] = listClass.code();
        missed[2 * list] = uint(missedPixels);
        missed[2 * list + 1] = uint(missedPixels >> 32);
    }
    /// The pixels of a list's tile that the map does not serve, bit tileBit each.
    std::uint64_t missedOf(std::size_t list) const {
        return missed[2 * list] | std::uint64_t(missed[2 * list + 1]) << 32;
    }
};

/// Of a position in a region whose tiles begin at its corner.
inline int tileBit(ivec2 position) {
    return position.y % kTileSize * kTileSize + position.x % kTileSize;
}
/// The bits of the pixels of a tile of which `size` lie in the region; more than kTileSize count as that.
std::uint64_t tilePixels(ivec2 size);

/// Where the outputs of a pattern lie on the lens when they are taken from the map: in their cells, as even
/// as can be.
std::vector<vec4> lensPoints(const OutputPattern& pattern);

/// See MapLayout::spreadPerPx.
float spreadPerPx(const OutputPattern& pattern);

/// What is seen at raster position x through lens position uv; nothing where no surface is met.
std::optional<vec3> lookThrough(const LayerMap& map, std::span<const Cluster> clusters, vec2 x, vec2 uv);

/// Adds to `share`, of the pixels of `frame` that a band finishes, what a chunk of its lists brings: 1 for a
/// list that the map serves there, 1/2 if it is inFocus, over `groups` in all.
void addMapShare(std::vector<float>& share, const Rect& frame, const Band& band, const ListClasses& classes,
                 std::size_t groups);

} // namespace slant

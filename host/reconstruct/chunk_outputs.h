// The outputs of one chunk on the CPU: from the layer map where it can serve them, else by searching the
// bins.
#pragma once
#include "base/monitor.h"
#include "reconstruct/film_buffer.h"
#include "reconstruct/lens_tiles.h"
#include "reconstruct/list_work.h"
#include "reconstruct/map_lookup.h"
#include "reconstruct/report.h"
#include "reconstruct/search.h"

#include <mutex>
#include <vector>

namespace slant {

class ChunkOutputs {
public:
    /// Outputs look through `lens` unless it is empty. What it refers to outlives it.
    ChunkOutputs(const Bins& bins, const BrickOrders& orders, const LensMap& lens,
                 const OutputPattern& pattern, const SearchKernel& kernel, const Chunk& chunk);

    void makeLists();
    /// Progress in outputs that the map serves.
    ListClasses lookUpMap(const LayerMap& map, Monitor& monitor);
    /// Progress in outputs that it does not serve.
    SearchCounts search(const ListWork& work, Monitor& monitor);
    /// Only these samples of `dense`, by index: those that the compute path leaves to the CPU.
    SearchCounts redo(std::span<const uint> indices);

    DenseSamples dense;
    TileLists lists;
    LensTiles lensTiles; ///< that the lists were made from, through a lens map

private:
    /// Where an output is stored, and in which list its bricks stand.
    struct Slot {
        std::size_t sample, list;
        ivec2 pixel;
        int output; ///< within the chunk
    };
    struct Counts {
        std::uint64_t visibility = 0;
        std::vector<Slot> holes;
    };

    int tileCount() const { return chunk_.layout.tileCount.x * chunk_.layout.tileCount.y; }
    std::uint64_t pixelsInside(ivec2 corner) const;
    TileLists listsWithin(float marginPx, LensTiles& lensTiles) const;
    LensSight sightOf(std::size_t group, std::size_t list) const;
    vec2 timesOf(std::size_t group) const;
    SearchContext contextOf(const TileLists& in, std::size_t list) const;
    Slot slotAt(ivec2 position, int output) const;
    Output at(const Slot& slot) const;
    int takenOf(bool sparse) const; ///< outputs of a group that are made
    int memberAt(std::size_t group, int rank, bool sparse) const;
    void store(const Slot& slot, const Output& output, const Reconstructed& result);
    std::uint64_t takeList(const LayerMap& map, std::size_t group, ivec2 corner, const ListClass& listClass);
    bool takePixel(const LayerMap& map, std::size_t group, ivec2 position, const ListClass& listClass);
    void searchPixel(std::size_t group, ivec2 position, bool sparse, Counts& counts);
    void searchSlot(const Slot& slot, Counts& counts);
    SearchCounts widen(Counts& counts);

    const Bins& bins_;
    const BrickOrders& orders_;
    const LensMap& lens_;
    const OutputPattern& pattern_;
    SearchKernel kernel_;
    Chunk chunk_;
    std::span<const LensBox> groups_;
    std::vector<vec4> lensPoints_; ///< of all outputs of the pattern
};

} // namespace slant

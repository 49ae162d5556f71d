// The CPU reconstruction of one chunk: some lens groups over one band of rows.
#pragma once
#include "base/monitor.h"
#include "reconstruct/film_buffer.h"
#include "reconstruct/lens_tiles.h"
#include "reconstruct/map_lookup.h"
#include "reconstruct/plan.h"
#include "reconstruct/search.h"

#include <mutex>
#include <vector>

namespace slant {

/// The outputs of a chunk of lens groups over one band.
class CpuChunk {
public:
    /// Outputs come from `map` where it serves, unless it is null; they look through `lens` unless it is
    /// empty.
    CpuChunk(const Bins& bins, const LayerMap* map, const LensMap& lens, const OutputPattern& pattern,
             const Band& band, std::uint64_t seed, std::size_t firstGroup, std::size_t groupCount);

    /// Lists, then every output; progress in outputs. Adds to the counts of `report`.
    void run(Monitor& monitor, ReconstructReport& report);

    /// Only these samples of `dense`, by index: those that the compute path leaves to the CPU. Adds to the
    /// counts of `report` but for the outputs.
    void redo(std::span<const uint> indices, ReconstructReport& report);

    DenseSamples dense;
    TileLists lists;
    std::vector<float> lensBounds; ///< that the lists are from, through a lens map
    ListClasses classes{0};

private:
    /// Where an output is stored, and in which list its bricks stand.
    struct Slot {
        std::size_t sample, list;
        ivec2 pixel;
        int output; ///< within the chunk
    };
    struct Counts {
        std::uint64_t outputs = 0, fromMap = 0, visibility = 0;
        std::vector<Slot> holes;
    };

    TileLists makeLists(float marginPx, std::vector<float>& lensTiles) const;
    SearchContext contextOf(const TileLists& in, std::size_t list) const;
    Slot slotAt(ivec2 position, int output) const;
    Output at(const Slot& slot) const;
    int takenOf(const ListClass& listClass) const; ///< outputs of a group that are made
    int memberAt(std::size_t group, int rank, const ListClass& listClass) const;
    void store(const Slot& slot, const Output& output, const Reconstructed& result);
    std::uint64_t runTile(std::size_t tile, Counts& counts); ///< dense samples of it
    std::uint64_t takeFromMap(std::size_t group, ivec2 corner, const ListClass& listClass);
    bool takePixel(std::size_t group, ivec2 position, const ListClass& listClass);
    void searchPixel(std::size_t group, ivec2 position, const ListClass& listClass, Counts& counts);
    void runSlot(const Slot& slot, Counts& counts);
    void add(const Counts& counts);
    void widen(ReconstructReport& report);

    const Bins& bins_;
    const LayerMap* map_;
    const LensMap& lens_;
    const OutputPattern& pattern_;
    OutputLayout layout_;
    std::size_t firstGroup_;
    std::span<const LensBox> groups_;
    std::vector<vec4> lensPoints_; ///< of all outputs of the pattern
    int firstOutput_, outputCount_;
    std::mutex mutex_;
    Counts counts_;
};

} // namespace slant

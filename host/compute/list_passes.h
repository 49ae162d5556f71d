// Stage "lists" on the device: the same words as makeTileLists (reconstruct/tile_lists.h).
#pragma once
#include "compute/bin_passes.h"
#include "reconstruct/output_pattern.h"

namespace slant {

struct DeviceLists {
    Buffer start;  ///< groups * tiles + 1
    Buffer ids;    ///< of bricks, one per entry
    Buffer bricks; ///< the bricks themselves
    Buffer cellBases;
};

class ListPasses {
public:
    /// Outputs of `pattern` look through `lens` unless it is empty; both must outlive this.
    ListPasses(Device& device, const OutputPattern& pattern, const LensMap& lens);

    /// Lists of push.groupCount groups from push.firstGroup on; push needs grid, outputs and brickTotal.
    /// Runs on `commands`, which must be empty, and leaves it empty.
    DeviceLists run(CommandList& commands, const DeviceBins& bins, OutputPush push, float marginPx);

    /// The tiles' bounds that the last lists are from, through a lens map.
    const std::vector<float>& lensBounds() const { return lensBounds_; }
    /// Of all groups: min, max.
    const Buffer& lensBoxes() const { return lensBoxes_; }

private:
    Device& device_;
    const OutputPattern& pattern_;
    const LensMap& lens_;
    Pass count_, emit_, start_, gather_;
    Scan scan_;
    RadixSort sort_;
    Buffer lensBoxes_;
    std::vector<float> lensBounds_;
};

} // namespace slant

// Stage "lists" on the device: the same words as makeTileLists (reconstruct/tile_lists.h).
#pragma once
#include "compute/bin_passes.h"
#include "reconstruct/output_pattern.h"

namespace slant {

struct DeviceLists {
    Buffer start;  ///< groups * tiles + 1
    Buffer ids;    ///< of bricks, one an entry
    Buffer bricks; ///< the bricks themselves
    Buffer cellBases;
};

class ListPasses {
public:
    ListPasses(Device& device, const std::vector<LensBox>& groups);

    /// Lists of push.groupCount groups from push.firstGroup on; push needs grid, outputs and brickTotal.
    /// Runs on `commands`, which must be empty, and leaves it empty.
    DeviceLists run(CommandList& commands, const DeviceBins& bins, OutputPush push, float marginPx);

    /// Of all groups: min, max.
    const Buffer& lensBoxes() const { return lensBoxes_; }

private:
    Device& device_;
    Pass count_, emit_, start_, gather_;
    Scan scan_;
    RadixSort sort_;
    Buffer lensBoxes_;
};

} // namespace slant

// Stage "lists" on the device: the same words as makeTileLists (reconstruct/tile_lists.h).
#pragma once
#include "compute/bin_passes.h"
#include "reconstruct/lens_tiles.h"
#include "reconstruct/output_pattern.h"

namespace slant {

struct DeviceLists {
    Buffer start;  ///< groups * tiles + 1
    Buffer ids;    ///< of bricks, one per entry; there may be more than in all lists
    Buffer bricks; ///< the bricks themselves
    Buffer cellBases;
    Buffer motions; ///< of the bricks, where things move
};

class ListPasses {
public:
    /// Outputs of `pattern` look through `lens` unless it is empty; both must outlive this.
    ListPasses(Device& device, const OutputPattern& pattern, const LensMap& lens, const DeviceBins& bins);

    /// Lists of push.groupCount groups from push.firstGroup on; push needs grid, outputs and brickTotal.
    /// Runs on `commands`, which must be empty, and leaves it empty.
    DeviceLists run(CommandList& commands, const DeviceBins& bins, OutputPush push, float marginPx);

    /// What the last lists are from, through a lens map.
    const LensTiles& lensTiles() const { return lensTiles_; }
    /// Of all groups: first, last, slot.
    const Buffer& groupTimes() const { return groupTimes_; }
    /// The picture's MotionLayout.
    const Buffer& motionTexels() const { return motionTexels_; }

private:
    ListPasses(Device& device, const OutputPattern& pattern, const LensMap& lens, const MotionGrid& motion,
               const BrickOrders& orders);

    Device& device_;
    const OutputPattern& pattern_;
    const LensMap& lens_;
    Pass count_, emit_, start_, gather_;
    Scan scan_;
    RadixSort sort_;
    Buffer lensBoxes_, brickOrder_, groupTimes_, motionTexels_;
    LensTiles lensTiles_;
};

} // namespace slant

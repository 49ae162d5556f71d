// Stage "bin" on the device: the same words as binSamples (reconstruct/bins.h).
#pragma once
#include "compute/radix_sort.h"
#include "reconstruct/motion_grid.h"

namespace slant {

struct DeviceBins {
    GridLayout grid{};
    uint brickTotal = 0;
    Buffer positions, values; ///< records in cell order; of the values, the radius ratios alone at first
    Buffer cellStart;         ///< brickTotal * cells of a brick + 1
    Buffer bricks;
    Buffer cellBases; ///< see bin_bricks.comp
    Buffer samples;   ///< index in the field of each record, and of what was not binned

    // Where things move; else empty.
    MotionGrid motion;
    Buffer motions, brickMotions;
    std::vector<vec2> brickRanks; ///< as Bins has them
};

class BinPasses {
public:
    BinPasses(Device& device, bool compoundLens, bool moves);

    /// Runs on `commands`, which must be empty, and leaves it empty.
    DeviceBins run(CommandList& commands, const SceneSideSamples& samples, const BinScope& scope);

private:
    /// What bin_place makes of the samples, in sample order, and bin_occlude.
    struct Placed;
    void place(CommandList& commands, const SceneSideSamples& source, BinPush push, Placed& placed);

    Device& device_;
    Pass place_, occlude_, gather_, bounds_, bricks_, cells_;
};

} // namespace slant

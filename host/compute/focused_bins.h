// The bins of one field on the device, for pictures at any focus: the same words as FocusedBins
// (reconstruct/focused_bins.h).
#pragma once
#include "compute/bin_passes.h"

#include <optional>

namespace slant {

class DeviceFocusedBins {
public:
    /// Bins the field. This, and what follows, runs on `commands`, which must be empty, and leaves it empty.
    DeviceFocusedBins(Device& device, CommandList& commands, const LightField& field, const BinScope& scope);

    const DeviceBins& at(CommandList& commands, float slopeShift);
    void takeRadiances(CommandList& commands, const LightField& field);

private:
    /// What slopes are in.
    struct Traced {
        GridLayout grid;
        Buffer positions, bricks;
    };

    Device& device_;
    DeviceBins bins_; ///< at the focus that was asked for last
    float slopeShift_ = 0;
    std::optional<Traced> traced_; ///< unset until another focus is asked for
};

} // namespace slant

// The bins of one field on the device, for pictures at any focus and of any plane of values: the same words
// as FieldBins (reconstruct/field_bins.h).
#pragma once
#include "compute/shading_passes.h"

#include <optional>

namespace slant {

class DeviceFieldBins {
public:
    /// Bins the samples, which must outlive it. This, and what follows, runs on `commands`, which must be
    /// empty, and leaves it empty.
    DeviceFieldBins(Device& device, CommandList& commands, const SceneSideSamples& samples,
                    const BinScope& scope);

    void refocus(CommandList& commands, float slopeShift);
    void takeValues(CommandList& commands, ValuePlane plane);
    void filterShading(CommandList& commands, const ShadingPlan& plan);
    const DeviceBins& bins() const { return bins_; }

private:
    /// What slopes are in.
    struct Traced {
        GridLayout grid;
        Buffer positions, bricks;
    };

    Device& device_;
    const SceneSideSamples& samples_;
    DeviceBins bins_; ///< at the focus that was asked for last
    float slopeShift_ = 0;
    std::optional<Traced> traced_; ///< unset until another focus is asked for
};

} // namespace slant

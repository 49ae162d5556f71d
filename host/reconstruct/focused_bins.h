// The bins of one field, for pictures at any focus and of anything that the samples know.
//
// Another focus adds the same to all slopes (lightfield/refocus.h). Pinhole positions stay, and with them the
// cells, the buckets, the order of records and what hides what. So a field is binned once, and a focus has
// only slopes of its own. The compute path does the same (compute/focused_bins.h).
#pragma once
#include "reconstruct/bins.h"

namespace slant {

/// A grid for slopes that are so much greater.
GridLayout refocused(GridLayout grid, float slopeShift);

class FocusedBins {
public:
    FocusedBins(const LightField& field, const BinScope& scope) : bins_(binSamples(field, scope)) {}

    /// The bins of samples whose slopes are so much greater than traced; good until the next call.
    const Bins& at(float slopeShift);

    /// Takes the radiances that the samples have by now; nothing else of `field` may have changed.
    void takeRadiances(const LightField& field);

private:
    Bins bins_; ///< at the focus that was asked for last
    float slopeShift_ = 0;
    /// As traced; empty until another focus is asked for.
    GridLayout tracedGrid_{};
    std::vector<Brick> tracedBricks_;
    std::vector<vec4> tracedPositions_;
};

} // namespace slant

// The bins of one field, for pictures at any focus and of any plane of values.
//
// Another focus adds the same to all slopes (lightfield/refocus.h). Pinhole positions stay, and with them the
// cells, the buckets, the order of records and what hides what. So a field is binned once, and each focus
// only needs its own slopes. The compute path does the same (compute/device_field_bins.h).
#pragma once
#include "reconstruct/shading_filter.h"

namespace slant {

/// The grid for slopes that are greater by this much.
GridLayout refocused(GridLayout grid, float slopeShift);

class FieldBins {
public:
    FieldBins(const SceneSideSamples& samples, const BinScope& scope)
        : samples_(samples), bins_(binSamples(samples, scope)) {}

    /// From now on slopes are greater than the traced ones by this much.
    void refocus(float slopeShift);
    void takeValues(ValuePlane plane) { slant::takeValues(bins_, samples_, plane); }
    void filterShading(const ShadingPlan& plan) { slant::filterShading(bins_, samples_, plan); }
    const Bins& bins() const { return bins_; }

private:
    const SceneSideSamples& samples_;
    Bins bins_; ///< at the focus that was asked for last
    float slopeShift_ = 0;
    /// As traced; empty until another focus is asked for.
    GridLayout tracedGrid_{};
    std::vector<Brick> tracedBricks_;
    std::vector<vec4> tracedPositions_;
};

} // namespace slant

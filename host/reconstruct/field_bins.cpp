#include "reconstruct/field_bins.h"

#include "base/parallel.h"

namespace slant {

GridLayout refocused(GridLayout grid, float slopeShift) {
    grid.slopeMin += slopeShift;
    return grid;
}

void FieldBins::refocus(float slopeShift) {
    if (slopeShift == slopeShift_) return;
    if (tracedPositions_.empty()) {
        tracedGrid_ = bins_.grid;
        tracedBricks_ = bins_.bricks;
        tracedPositions_ = bins_.positions;
    }
    slopeShift_ = slopeShift;
    bins_.grid = refocused(tracedGrid_, slopeShift);
    bins_.motion.layout.c2 = samples_.field().slopeModel.c2 + slopeShift;
    for (std::size_t i = 0; i < bins_.bricks.size(); ++i) {
        bins_.bricks[i].slopeMin = tracedBricks_[i].slopeMin + slopeShift;
        bins_.bricks[i].slopeMax = tracedBricks_[i].slopeMax + slopeShift;
    }
    parallelFor(0, bins_.positions.size(), 1 << 15, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) bins_.positions[i].z = tracedPositions_[i].z + slopeShift;
    });
}

} // namespace slant

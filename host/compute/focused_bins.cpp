#include "compute/focused_bins.h"

#include "base/parallel.h"
#include "reconstruct/focused_bins.h"

namespace slant {

DeviceFocusedBins::DeviceFocusedBins(Device& device, CommandList& commands, const LightField& field,
                                     const BinScope& scope)
    : device_(device), bins_(BinPasses(device).run(commands, field, scope)) {}

const DeviceBins& DeviceFocusedBins::at(CommandList& commands, float slopeShift) {
    if (slopeShift == slopeShift_) return bins_;
    if (!traced_) {
        traced_ = {bins_.grid, std::move(bins_.positions), std::move(bins_.bricks)};
        bins_.positions = Buffer(device_, traced_->positions.format(), traced_->positions.texels());
        bins_.bricks = Buffer(device_, traced_->bricks.format(), traced_->bricks.texels());
    }
    slopeShift_ = slopeShift;
    bins_.grid = refocused(traced_->grid, slopeShift);
    const Pass pass(device_, "bin_refocus");
    const RefocusPush push{bins_.grid.sampleCount, bins_.brickTotal, slopeShift};
    // There are no more bricks than records.
    commands.dispatch(pass, {traced_->positions, traced_->bricks, bins_.positions, bins_.bricks}, push,
                      pass.gridFor(push.recordCount));
    commands.run();
    return bins_;
}

void DeviceFocusedBins::takeRadiances(CommandList& commands, const LightField& field) {
    std::vector<vec4> radiances(field.samples.size());
    parallelFor(0, radiances.size(), 1 << 15, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const LightFieldSample& s = field.samples[i];
            radiances[i] = vec4(s.r, s.g, s.b, 0);
        }
    });
    Buffer ofSamples(device_, TexelFormat::rgba32f, radiances.size());
    ofSamples.upload(radiances);
    const Pass pass(device_, "bin_radiances");
    const CountPush push{bins_.grid.sampleCount};
    commands.dispatch(pass, {bins_.samples, ofSamples, bins_.radiances}, push, pass.gridFor(push.count));
    commands.run();
}

} // namespace slant

#include "compute/device_field_bins.h"

#include "compute/field_buffers.h"
#include "reconstruct/field_bins.h"

namespace slant {
DeviceFieldBins::DeviceFieldBins(Device& device, CommandList& commands, const SceneSideSamples& samples,
                                 const BinScope& scope)
    : device_(device), samples_(samples),
      bins_(BinPasses(device, !samples.areaExcess().empty(), samples.field().moves())
                .run(commands, samples, scope)) {}

void DeviceFieldBins::refocus(CommandList& commands, float slopeShift) {
    if (slopeShift == slopeShift_) return;
    if (!traced_) {
        traced_ = {bins_.grid, std::move(bins_.positions), std::move(bins_.bricks)};
        bins_.positions = Buffer(device_, traced_->positions.format(), traced_->positions.texels());
        bins_.bricks = Buffer(device_, traced_->bricks.format(), traced_->bricks.texels());
    }
    slopeShift_ = slopeShift;
    bins_.grid = refocused(traced_->grid, slopeShift);
    bins_.motion.layout.c2 = samples_.field().slopeModel.c2 + slopeShift;
    const Pass pass(device_, "bin_refocus");
    const RefocusPush push{bins_.grid.sampleCount, bins_.brickTotal, slopeShift};
    // There are no more bricks than records.
    commands.dispatch(pass, {traced_->positions, traced_->bricks, bins_.positions, bins_.bricks}, push,
                      pass.gridFor(push.recordCount));
    commands.run();
}

void DeviceFieldBins::takeValues(CommandList& commands, ValuePlane plane) {
    const Buffer ofSamples = sampleBuffer(device_, samples_.samples().size(),
                                          [&](std::size_t i) { return vec4(samples_.value(plane, i), 0); });
    const Pass pass(device_, "bin_values");
    const CountPush push{bins_.grid.sampleCount};
    commands.dispatch(pass, {bins_.samples, ofSamples, bins_.values}, push, pass.gridFor(push.count));
    commands.run();
}

void DeviceFieldBins::filterShading(CommandList& commands, const ShadingPlan& plan) {
    const ShadingPasses passes(device_, samples_, plan);
    for (const ShadingBand& band : plan.bands) passes.run(commands, bins_, band);
}

} // namespace slant

#include "compute/device_field_bins.h"

#include "base/parallel.h"
#include "reconstruct/field_bins.h"

#include <algorithm>

namespace slant {
namespace {

/// Values uploaded at a time: 16 MiB.
constexpr std::size_t kUploadValues = std::size_t(1) << 20;

} // namespace

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
    const std::size_t count = samples_.samples().size();
    Buffer ofSamples(device_, TexelFormat::rgba32f, count);
    std::vector<vec4> part(std::min(kUploadValues, count));
    for (std::size_t begin = 0; begin < count; begin += part.size()) {
        part.resize(std::min(kUploadValues, count - begin));
        parallelFor(0, part.size(), 1 << 15, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) part[i] = vec4(samples_.value(plane, begin + i), 0);
        });
        ofSamples.upload(part, begin);
    }
    const Pass pass(device_, "bin_values");
    const CountPush push{bins_.grid.sampleCount};
    commands.dispatch(pass, {bins_.samples, ofSamples, bins_.values}, push, pass.gridFor(push.count));
    commands.run();
}

void DeviceFieldBins::filterShading(CommandList& commands, const ShadingBand& band) {
    ShadingPasses(device_, samples_).run(commands, bins_, band);
}

} // namespace slant

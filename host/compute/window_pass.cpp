#include "compute/window_pass.h"

#include "compute/field_buffers.h"

#include <algorithm>
#include <numeric>

namespace slant {
namespace {

template <typename Texels>
Buffer uploaded(Device& device, TexelFormat format, const Texels& texels) {
    Buffer buffer(device, format, std::size(texels));
    buffer.upload(texels);
    return buffer;
}

MotionLayout layoutOf(const PatternShutter& shutter) {
    MotionLayout layout{};
    layout.shutterOpen = shutter.open;
    layout.shutterSpan = shutter.span;
    return layout;
}

} // namespace

WindowPass::WindowPass(Device& device, const WindowSamples& samples, const WindowSearch& search,
                       const LensMap& lens, const OutputPattern& pattern)
    : device_(device), search_(search), lensCells_(pattern.lensCells), lensScale_(pattern.lensScale),
      pass_(device, "window", fieldConstants(!lens.empty(), pattern.shutter.moves)),
      positions_(uploaded(device, TexelFormat::rgba32f, samples.positions)),
      values_(uploaded(device, TexelFormat::rgba32f, samples.values)),
      motions_(uploaded(device, TexelFormat::rgba32f, samples.motions)),
      motionTexels_(motionBuffer(device, layoutOf(pattern.shutter))),
      pixelStart_(uploaded(device, TexelFormat::r32ui, samples.pixelStart)),
      entries_(uploaded(device, TexelFormat::rgba32ui, pattern.entries)),
      aperture_(uploaded(device, TexelFormat::r32f, pattern.aperture.table())),
      lensMap_(lensBuffer(device, lens)), counters_(device, TexelFormat::r32ui, kCounters),
      overflowList_(device, TexelFormat::r32ui, 0) {}

WindowPass::Result WindowPass::run(CommandList& commands, const Chunk& chunk, std::uint64_t stepsPerOutput,
                                   const Buffer& dense) {
    Result result;
    if (stepsPerOutput > std::uint64_t(kMaxWindowSteps)) {
        result.overflowed.resize(chunk.outputs());
        std::iota(result.overflowed.begin(), result.overflowed.end(), 0u);
        result.counts.overflowed = result.overflowed.size();
        return result;
    }
    if (overflowList_.texels() < chunk.outputs())
        overflowList_ = Buffer(device_, TexelFormat::r32ui, chunk.outputs());
    WindowPush push{};
    push.search = search_;
    push.outputs = chunk.layout;
    push.lensCells = lensCells_;
    push.lensScale = lensScale_;
    push.firstOutput = chunk.firstOutput;
    push.count = uint(chunk.outputs());
    commands.fill(counters_, 0);
    commands.dispatch(pass_,
                      {positions_, values_, entries_, dense, counters_, overflowList_, aperture_, pixelStart_,
                       lensMap_, motions_, motionTexels_},
                      push, pass_.gridFor(push.count));
    commands.run();
    std::vector<uint> counts(kCounters);
    counters_.download(std::span(counts));
    result.counts = {counts[kVisibilityCount], counts[kFilledCount], counts[kHoleCount],
                     counts[kOverflowCount]};
    result.overflowed.resize(counts[kOverflowCount]);
    overflowList_.download(std::span(result.overflowed));
    std::sort(result.overflowed.begin(), result.overflowed.end());
    return result;
}

} // namespace slant

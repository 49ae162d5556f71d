#include "compute/output_passes.h"

#include "compute/field_buffers.h"
#include "reconstruct/grid.h"

#include <algorithm>

namespace slant {

OutputPasses::OutputPasses(Device& device, const OutputPattern& pattern, const LensMap& lens,
                           const SearchKernel& kernel)
    : device_(device), search_(device, kernel.pass, fieldConstants(!lens.empty(), pattern.shutter.moves)),
      visibility_(device, "visibility", fieldConstants(!lens.empty(), pattern.shutter.moves)),
      pattern_(device, TexelFormat::rgba32ui, pattern.entries.size()),
      aperture_(device, TexelFormat::r32f, pattern.aperture.table().size()),
      lensMap_(lensBuffer(device, lens)), counters_(device, TexelFormat::r32ui, kCounters),
      visibilityList_(device, TexelFormat::r32ui, 0), holeList_(device, TexelFormat::r32ui, 0),
      overflowList_(device, TexelFormat::r32ui, 0) {
    pattern_.upload(std::span(pattern.entries));
    aperture_.upload(pattern.aperture.table());
}

void OutputPasses::reserve(std::uint64_t samples) {
    if (visibilityList_.texels() >= samples) return;
    for (Buffer* list : {&visibilityList_, &holeList_, &overflowList_})
        *list = Buffer(device_, TexelFormat::r32ui, samples);
}

OutputPasses::Counters OutputPasses::counters() const {
    Counters words(kCounters);
    counters_.download(std::span(words));
    return words;
}

OutputPasses::Result OutputPasses::run(CommandList& commands, ListPasses& listPasses, const DeviceBins& bins,
                                       const DeviceLists& lists, const ListWork& work, const Buffer& missed,
                                       OutputPush push, const Buffer& dense) {
    reserve(dense.texels());
    commands.fill(counters_, 0);
    push.baseRadiusPx = bins.grid.radiusPx;
    for (const auto& [items, bits] :
         {std::pair(&work.whole, push.groupBits), {&work.sparse, push.takenBits}}) {
        push.count = uint(items->size());
        push.takenBits = bits;
        Buffer buffer(device_, TexelFormat::rgba32ui, items->size());
        buffer.upload(std::span(*items));
        commands.dispatch(search_,
                          {bins.positions, bins.values, bins.cellStart, lists.start, lists.cellBases,
                           lists.bricks, bins.motions, lists.motions, listPasses.motionTexels(), pattern_,
                           dense, counters_, visibilityList_, overflowList_, buffer, aperture_, lensMap_,
                           missed},
                          push, search_.gridFor((std::uint64_t(push.count) * kTileSize * kTileSize) << bits));
        commands.run();
    }

    Result result;
    SearchCounts& found = result.counts;
    const Counters first = counters();
    found.visibility = push.count = first[kVisibilityCount];
    const auto look = [&](const DeviceLists& in) {
        commands.dispatch(visibility_,
                          {bins.positions, bins.values, bins.cellStart, in.start, in.cellBases, in.bricks,
                           bins.motions, in.motions, listPasses.motionTexels(), pattern_, visibilityList_,
                           dense, counters_, holeList_, overflowList_, aperture_, lensMap_},
                          push, visibility_.gridFor(push.count));
        commands.run();
        return counters();
    };
    const Counters second = look(lists);
    found.widened = found.holes = second[kHoleCount];
    for (int step = 0; step < kWidenings && found.holes > 0; ++step) {
        push.baseRadiusPx *= 2;
        push.count = uint(found.holes);
        std::swap(visibilityList_, holeList_);
        const DeviceLists wide = listPasses.run(commands, bins, push, 2 * push.baseRadiusPx);
        const uint none = 0;
        counters_.upload(std::span(&none, 1), kHoleCount);
        found.holes = look(wide)[kHoleCount];
    }
    const uint overflowed = counters()[kOverflowCount];
    found.visibility -= overflowed - first[kOverflowCount];
    found.widened -= overflowed - second[kOverflowCount];
    found.overflowed = overflowed;
    result.overflowed.resize(overflowed);
    overflowList_.download(std::span(result.overflowed));
    std::sort(result.overflowed.begin(), result.overflowed.end());
    return result;
}

} // namespace slant

#include "compute/list_passes.h"

#include "compute/lens_buffer.h"
#include "reconstruct/lens_tiles.h"

#include <bit>

namespace slant {
namespace {

Buffer uploadBoxes(Device& device, const std::vector<LensBox>& groups) {
    static_assert(sizeof(LensBox) == sizeof(vec4));
    Buffer boxes(device, TexelFormat::rgba32f, groups.size());
    boxes.upload(groups);
    return boxes;
}

} // namespace

ListPasses::ListPasses(Device& device, const OutputPattern& pattern, const LensMap& lens)
    : device_(device), pattern_(pattern), lens_(lens), count_(device, "list_count", compoundLens(lens)),
      emit_(device, "list_emit", compoundLens(lens)), start_(device, "list_start"),
      gather_(device, "list_gather"), scan_(device, 1), sort_(device, 1),
      lensBoxes_(uploadBoxes(device, pattern.groups)) {}

DeviceLists ListPasses::run(CommandList& commands, const DeviceBins& bins, OutputPush push, float marginPx) {
    push.marginPx = marginPx;
    if (!lens_.empty())
        lensBounds_ = lensTileBounds(lens_, pattern_, push.firstGroup, push.groupCount, push.grid,
                                     push.outputs, marginPx);
    Buffer lensTiles(device_, TexelFormat::r32f, lensBounds_.size());
    lensTiles.upload(lensBounds_);
    push.count = push.groupCount * bins.brickTotal;
    Buffer offsets(device_, TexelFormat::r32ui, push.count + 1);
    commands.dispatch(count_, {bins.bricks, lensBoxes_, offsets, lensTiles}, push,
                      count_.gridFor(push.count + 1));
    scan_.reserve(push.count + 1);
    scan_.record(commands, offsets, push.count + 1);
    commands.run();
    uint entries = 0;
    offsets.download(std::span(&entries, 1), push.count);

    const uint lists = push.groupCount * uint(push.outputs.tileCount.x) * uint(push.outputs.tileCount.y);
    PairBuffers pairs(device_, entries), scratch(device_, entries);
    push.count = entries;
    commands.dispatch(emit_, {bins.bricks, lensBoxes_, offsets, pairs.keys, pairs.values, lensTiles}, push,
                      emit_.gridFor(entries));
    sort_.reserve(entries);
    const bool inScratch =
        &sort_.record(commands, pairs, scratch, entries, std::bit_width(lists - 1)) == &scratch;
    PairBuffers& sorted = inScratch ? scratch : pairs;
    Buffer start(device_, TexelFormat::r32ui, lists + 1);
    commands.dispatch(start_, {sorted.keys, start}, LowerBoundPush{entries, lists + 1},
                      start_.gridFor(lists + 1));
    Buffer bricks(device_, TexelFormat::rgba32ui, entries), cellBases(device_, TexelFormat::r32ui, entries);
    commands.dispatch(gather_, {sorted.values, bins.bricks, bins.cellBases, bricks, cellBases}, push,
                      gather_.gridFor(entries));
    commands.run();
    return {std::move(start), std::move(sorted.values), std::move(bricks), std::move(cellBases)};
}

} // namespace slant

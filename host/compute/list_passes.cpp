#include "compute/list_passes.h"

#include "compute/field_buffers.h"

#include <bit>

namespace slant {
namespace {

Buffer uploadBoxes(Device& device, const std::vector<LensBox>& groups) {
    static_assert(sizeof(LensBox) == sizeof(vec4));
    Buffer boxes(device, TexelFormat::rgba32f, groups.size());
    boxes.upload(groups);
    return boxes;
}

Buffer uploadOrders(Device& device, const BrickOrders& orders) {
    std::vector<uint> all;
    for (const std::vector<uint>& order : orders.all()) all.insert(all.end(), order.begin(), order.end());
    Buffer buffer(device, TexelFormat::r32ui, all.size());
    buffer.upload(all);
    return buffer;
}

/// First, last, slot; of every group, also where nothing moves.
Buffer uploadTimes(Device& device, const OutputPattern& pattern, const BrickOrders& orders) {
    std::vector<vec4> times(pattern.groups.size(), vec4(0));
    for (std::size_t i = 0; i < pattern.times.size(); ++i)
        times[i] = vec4(pattern.times[i], float(orders.storedAt(pattern.slotOf(i))), 0);
    Buffer buffer(device, TexelFormat::rgba32f, times.size());
    buffer.upload(times);
    return buffer;
}

MotionLayout layoutOf(const MotionGrid& motion, const PatternShutter& shutter) {
    MotionLayout layout = motion.layout;
    layout.shutterOpen = shutter.open;
    layout.shutterSpan = shutter.span;
    return layout;
}

} // namespace

ListPasses::ListPasses(Device& device, const OutputPattern& pattern, const LensMap& lens,
                       const DeviceBins& bins)
    : ListPasses(device, pattern, lens, bins.motion,
                 BrickOrders(bins.motion, bins.brickRanks, pattern.slotTimes())) {}

ListPasses::ListPasses(Device& device, const OutputPattern& pattern, const LensMap& lens,
                       const MotionGrid& motion, const BrickOrders& orders)
    : device_(device), pattern_(pattern), lens_(lens),
      count_(device, "list_count", fieldConstants(!lens.empty(), motion.moves())),
      emit_(device, "list_emit", fieldConstants(!lens.empty(), motion.moves())), start_(device, "list_start"),
      gather_(device, "list_gather", fieldConstants(!lens.empty(), motion.moves())), scan_(device, 1),
      sort_(device, 1), lensBoxes_(uploadBoxes(device, pattern.groups)),
      brickOrder_(uploadOrders(device, orders)), groupTimes_(uploadTimes(device, pattern, orders)),
      motionTexels_(motionBuffer(device, layoutOf(motion, pattern.shutter))) {}

DeviceLists ListPasses::run(CommandList& commands, const DeviceBins& bins, OutputPush push, float marginPx) {
    push.marginPx = marginPx;
    if (!lens_.empty())
        lensTiles_ =
            lensTilesOf(lens_, pattern_, push.firstGroup, push.groupCount, push.grid, push.outputs, marginPx);
    Buffer lensTiles(device_, TexelFormat::r32f, lensTiles_.bounds.size());
    lensTiles.upload(lensTiles_.bounds);
    push.count = push.groupCount * bins.brickTotal;
    Buffer offsets(device_, TexelFormat::r32ui, push.count + 1),
        ranges(device_, TexelFormat::rgba32ui, push.count);
    commands.dispatch(count_,
                      {bins.bricks, lensBoxes_, offsets, lensTiles, bins.brickMotions, brickOrder_,
                       groupTimes_, motionTexels_, ranges},
                      push, count_.gridFor(push.count + 1));
    scan_.reserve(push.count + 1);
    scan_.record(commands, offsets, push.count + 1);
    commands.run();
    uint entries = 0;
    offsets.download(std::span(&entries, 1), push.count);

    const uint lists = push.groupCount * uint(push.outputs.tileCount.x) * uint(push.outputs.tileCount.y);
    PairBuffers pairs(device_, entries), scratch(device_, entries);
    push.count = entries;
    Buffer boxes(device_, TexelFormat::rgba32f, lensTiles_.boxes.size());
    boxes.upload(lensTiles_.boxes);
    commands.dispatch(emit_,
                      {ranges, offsets, pairs.keys, pairs.values, bins.bricks, bins.brickMotions, groupTimes_,
                       motionTexels_, boxes},
                      push, emit_.gridFor(entries));
    sort_.reserve(entries);
    const bool inScratch = &sort_.record(commands, pairs, scratch, entries,
                                         std::bit_width(lens_.empty() ? lists - 1 : lists)) == &scratch;
    PairBuffers& sorted = inScratch ? scratch : pairs;
    Buffer start(device_, TexelFormat::r32ui, lists + 1);
    commands.dispatch(start_, {sorted.keys, start}, LowerBoundPush{entries, lists + 1},
                      start_.gridFor(lists + 1));
    Buffer bricks(device_, TexelFormat::rgba32ui, entries), cellBases(device_, TexelFormat::r32ui, entries);
    Buffer motions(device_, TexelFormat::rgba32f, bins.motion.moves() ? entries * kBrickMotionTexels : 0);
    commands.dispatch(
        gather_, {sorted.values, bins.bricks, bins.cellBases, bricks, cellBases, bins.brickMotions, motions},
        push, gather_.gridFor(entries));
    commands.run();
    return {std::move(start), std::move(sorted.values), std::move(bricks), std::move(cellBases),
            std::move(motions)};
}

} // namespace slant

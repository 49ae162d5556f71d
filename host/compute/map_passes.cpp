#include "compute/map_passes.h"

#include "compute/field_buffers.h"

namespace slant {

MapPasses::MapPasses(Device& device, const OutputPattern& pattern, const DeviceBins& bins)
    : device_(device), map_(device, "layer_map", fieldConstants(false, bins.motion.moves())),
      reduce_(device, "map_reduce", fieldConstants(false, bins.motion.moves())),
      classify_(device, "list_classify", fieldConstants(false, bins.motion.moves())),
      lookup_(device, "map_lookup", fieldConstants(false, bins.motion.moves())),
      texels_(device, TexelFormat::rgba32ui, 0), motions_(device, TexelFormat::rgba32ui, 0),
      motionTexels_(motionBuffer(device, bins.motion.layout)),
      lensPoints_(device, TexelFormat::rgba32f, pattern.entries.size()),
      clusters_(device, TexelFormat::rgba32f, 0), moves_(bins.motion.moves()) {
    lensPoints_.upload(lensPoints(pattern));
}

void MapPasses::makeMap(CommandList& commands, const DeviceBins& bins, const MapLayout& layout,
                        const std::function<MapTexel(ivec2)>& resolve) {
    layout_ = layout;
    const std::size_t base = levelBegin(layout_, 1), texels = levelBegin(layout_, layout_.levels);
    texels_ = Buffer(device_, TexelFormat::rgba32ui, texels);
    motions_ = Buffer(device_, TexelFormat::rgba32ui, moves_ ? texels : 0);

    OutputPush push{};
    push.grid = bins.grid;
    push.outputs = mapTiles(layout_);
    push.groupCount = 1;
    push.brickTotal = bins.brickTotal;
    push.baseRadiusPx = layout_.tentPx;
    OutputPattern center;
    center.groups = {{vec2(0), vec2(0)}};
    const LensMap noLens;
    ListPasses listPasses(device_, center, noLens, bins);
    const DeviceLists lists = listPasses.run(commands, bins, push, 2 * layout_.tentPx);
    Buffer counters(device_, TexelFormat::r32ui, kCounters), overflowList(device_, TexelFormat::r32ui, base);
    commands.fill(counters, 0);
    commands.dispatch(map_,
                      {bins.positions, bins.values, bins.cellStart, lists.start, lists.cellBases,
                       lists.bricks, bins.motions, lists.motions, listPasses.motionTexels(), texels_,
                       counters, overflowList, motions_},
                      push, map_.gridOver(std::uint32_t(layout_.size.x), std::uint32_t(layout_.size.y)));
    commands.run();
    uint overflowed = 0;
    counters.download(std::span(&overflowed, 1), kOverflowCount);
    std::vector<uint> indices(overflowed);
    overflowList.download(indices);
    for (const uint index : indices) {
        const MapTexel texel = resolve(ivec2(int(index) % layout_.size.x, int(index) / layout_.size.x));
        const glm::uvec4 words = packTexel(texel, layout_.code);
        texels_.upload(std::span(&words, 1), index);
        const glm::uvec4 motions = packMotions(texel, bins.motion.layout);
        if (moves_) motions_.upload(std::span(&motions, 1), index);
    }
    for (int level = 1; level < layout_.levels; ++level) {
        const ivec2 size = levelSize(layout_, level);
        const ReducePush reduce{levelSize(layout_, level - 1), uint(levelBegin(layout_, level - 1)),
                                uint(levelBegin(layout_, level)), layout_.surfaceGap, layout_.code};
        commands.dispatch(reduce_, {texels_, motions_, motionTexels_}, reduce,
                          reduce_.gridOver(std::uint32_t(size.x), std::uint32_t(size.y)));
    }
    commands.run();
}

void MapPasses::record(CommandList& commands, const ListPasses& listPasses, const DeviceLists& lists,
                       const Buffer& pattern, const OutputPush& outputs, const Buffer& classes,
                       const Buffer& missed, const Buffer& dense) {
    MapLookupPush push{};
    push.outputs = outputs.outputs;
    push.map = layout_;
    push.firstGroup = outputs.firstGroup;
    push.count = uint(lists.start.texels() - 1);
    push.groupBits = outputs.groupBits;
    push.lensScale = outputs.lensScale;
    push.sparseBits = outputs.takenBits;
    const std::uint64_t clusterTexels = lists.bricks.texels() * (moves_ ? kClusterTexels : 1);
    if (clusters_.texels() < clusterTexels) clusters_ = Buffer(device_, TexelFormat::rgba32f, clusterTexels);
    commands.dispatch(classify_,
                      {lists.start, lists.bricks, listPasses.lensBoxes(), classes, clusters_, missed,
                       lists.motions, listPasses.groupTimes(), motionTexels_},
                      push, classify_.gridFor(push.count));
    commands.dispatch(lookup_,
                      {lists.start, clusters_, texels_, lensPoints_, pattern, classes, dense, missed,
                       motions_, listPasses.motionTexels()},
                      push,
                      {std::uint32_t(outputs.outputs.tileCount.x), std::uint32_t(outputs.outputs.tileCount.y),
                       outputs.groupCount});
}

} // namespace slant

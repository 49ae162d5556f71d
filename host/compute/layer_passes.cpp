#include "compute/layer_passes.h"

namespace slant {

LayerPasses::LayerPasses(Device& device, const OutputPattern& pattern)
    : device_(device), pattern_(pattern), texels_(device, "layer_map"), reduce_(device, "layer_reduce"),
      rungsPass_(device, "rungs"), outputs_(device, "layers"), heads_(device, TexelFormat::rgba32f, 0),
      layers_(device, TexelFormat::rgba32f, 0),
      lensPoints_(device, TexelFormat::rgba32f, pattern.entries.size()),
      clusters_(device, TexelFormat::r32f, 0) {
    lensPoints_.upload(lensPoints(pattern));
}

void LayerPasses::makeMap(CommandList& commands, const DeviceBins& bins, const MapLayout& layout,
                          const std::function<MapTexel(vec2)>& resolve) {
    layout_ = layout;
    const std::size_t base = levelBegin(layout_, 1), texels = levelBegin(layout_, layout_.levels);
    heads_ = Buffer(device_, TexelFormat::rgba32f, texels);
    layers_ = Buffer(device_, TexelFormat::rgba32f, texels * kMapLayers);

    OutputPush push{};
    push.grid = bins.grid;
    push.outputs = mapTiles(layout_);
    push.groupCount = 1;
    push.brickTotal = bins.brickTotal;
    push.radiusPx = mapRadius(bins.grid);
    ListPasses listPasses(device_, std::vector<LensBox>{{vec2(0), vec2(0)}});
    const DeviceLists lists = listPasses.run(commands, bins, push, 2 * push.radiusPx);
    Buffer counters(device_, TexelFormat::r32ui, kCounters), overflowList(device_, TexelFormat::r32ui, base);
    commands.fill(counters, 0);
    commands.dispatch(texels_,
                      {bins.positions, bins.radiances, bins.cellStart, lists.start, lists.cellBases,
                       lists.bricks, heads_, layers_, counters, overflowList},
                      push, texels_.gridOver(std::uint32_t(layout_.size.x), std::uint32_t(layout_.size.y)));
    commands.run();
    uint overflowed = 0;
    counters.download(std::span(&overflowed, 1), kOverflowCount);
    std::vector<uint> indices(overflowed);
    overflowList.download(indices);
    for (const uint index : indices) {
        const MapTexel texel =
            resolve(texelCenter(layout_, ivec2(int(index) % layout_.size.x, int(index) / layout_.size.x)));
        heads_.upload(std::span(&texel.head, 1), index);
        layers_.upload(texel.layers, std::uint64_t(index) * kMapLayers);
    }
    for (int level = 1; level < layout_.levels; ++level) {
        const ivec2 size = levelSize(layout_, level);
        const ReducePush reduce{levelSize(layout_, level - 1), uint(levelBegin(layout_, level - 1)),
                                uint(levelBegin(layout_, level)), layout_.surfaceGap};
        commands.dispatch(reduce_, {heads_, layers_}, reduce,
                          reduce_.gridOver(std::uint32_t(size.x), std::uint32_t(size.y)));
    }
    commands.run();
}

void LayerPasses::record(CommandList& commands, const ListPasses& listPasses, const DeviceLists& lists,
                         const OutputPush& outputs, const Buffer& rungs, const Buffer& dense) {
    LayerPush push{};
    push.outputs = outputs.outputs;
    push.map = layout_;
    push.firstGroup = outputs.firstGroup;
    push.count = uint(lists.start.texels() - 1);
    push.groupBits = outputs.groupBits;
    push.lensScale = outputs.lensScale;
    if (clusters_.texels() < 2 * lists.bricks.texels())
        clusters_ = Buffer(device_, TexelFormat::r32f, 2 * lists.bricks.texels());
    commands.dispatch(rungsPass_, {lists.start, lists.bricks, listPasses.lensBoxes(), rungs, clusters_}, push,
                      rungsPass_.gridFor(push.count));
    commands.dispatch(outputs_, {lists.start, clusters_, heads_, layers_, lensPoints_, rungs, dense}, push,
                      {std::uint32_t(outputs.outputs.tileCount.x), std::uint32_t(outputs.outputs.tileCount.y),
                       outputs.groupCount});
}

} // namespace slant

#include "compute/map_passes.h"

#include "compute/field_buffers.h"

namespace slant {

MapPasses::MapPasses(Device& device, const OutputPattern& pattern, const LensMap& lens,
                     const LensDistortion& distortion, const DeviceBins& bins)
    : device_(device), lens_(lens), distortion_(distortion),
      map_(device, "layer_map", fieldConstants(!lens.empty(), bins.motion.moves())),
      reduce_(device, "map_reduce", fieldConstants(!lens.empty(), bins.motion.moves())),
      classify_(device, "list_classify", fieldConstants(!lens.empty(), bins.motion.moves())),
      lookup_(device, "map_lookup", fieldConstants(!lens.empty(), bins.motion.moves())),
      texels_(device, TexelFormat::rgba32ui, 0), motions_(device, TexelFormat::rgba32ui, 0),
      motionTexels_(motionBuffer(device, bins.motion.layout)),
      lensPoints_(device, TexelFormat::rgba32f, pattern.entries.size()),
      aperture_(device, TexelFormat::r32f, pattern.aperture.table().size()),
      clusters_(device, TexelFormat::rgba32f, 0), lensMap_(lensBuffer(device, lens)),
      pinholeMap_(lensBuffer(device, distortion.pinhole())),
      distortionTexels_(device, TexelFormat::rgba32f, distortion.texels().size()),
      sights_(device, TexelFormat::rgba32f, pattern.groups.size()), moves_(bins.motion.moves()) {
    lensPoints_.upload(lensPoints(pattern));
    aperture_.upload(pattern.aperture.table());
    distortionTexels_.upload(distortion.texels());
    std::vector<LensSight> sights;
    for (const LensBox& group : pattern.groups) sights.push_back(sightThrough(group, pattern.lensScale));
    sights_.upload(sights);
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
    const OutputPattern pattern = mapPattern();
    ListPasses listPasses(device_, pattern, distortion_.pinhole(), bins);
    const DeviceLists lists = listPasses.run(commands, bins, push, 2 * layout_.tentPx);
    Buffer counters(device_, TexelFormat::r32ui, kCounters), overflowList(device_, TexelFormat::r32ui, base);
    commands.fill(counters, 0);
    commands.dispatch(map_,
                      {bins.positions, bins.values, bins.cellStart, lists.start, lists.cellBases,
                       lists.bricks, bins.motions, lists.motions, listPasses.motionTexels(), texels_,
                       counters, overflowList, motions_, pinholeMap_},
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
    push.sparseBits = outputs.takenBits;
    push.lensCells = outputs.lensCells;
    push.lensScale = outputs.lensScale;
    const std::uint64_t clusterTexels = lists.bricks.texels() * (moves_ ? kClusterTexels : 1);
    if (clusters_.texels() < clusterTexels) clusters_ = Buffer(device_, TexelFormat::rgba32f, clusterTexels);
    if (!lens_.empty()) {
        const std::vector<LensSight>& sights = listPasses.lensTiles().sights;
        sights_ = Buffer(device_, TexelFormat::rgba32f, sights.size());
        sights_.upload(sights);
    }
    commands.dispatch(classify_,
                      {lists.start, lists.bricks, sights_, classes, clusters_, missed, lists.motions,
                       listPasses.groupTimes(), motionTexels_},
                      push, classify_.gridFor(push.count));
    commands.dispatch(lookup_,
                      {lists.start, clusters_, texels_, lensPoints_, pattern, classes, dense, missed,
                       motions_, listPasses.motionTexels(), lensMap_, distortionTexels_, aperture_},
                      push,
                      {std::uint32_t(outputs.outputs.tileCount.x), std::uint32_t(outputs.outputs.tileCount.y),
                       outputs.groupCount});
}

} // namespace slant

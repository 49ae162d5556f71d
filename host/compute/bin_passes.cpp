#include "compute/bin_passes.h"

#include "reconstruct/occlusion.h"

#include <algorithm>

namespace slant {
namespace {

/// Samples uploaded at a time: 48 MiB.
constexpr std::size_t kUploadSamples = std::size_t(1) << 20;
constexpr std::uint64_t kTexelsPerSample = sizeof(LightFieldSample) / sizeof(vec4);

uint lastWord(const Buffer& buffer) {
    uint word = 0;
    buffer.download(std::span(&word, 1), buffer.texels() - 1);
    return word;
}

} // namespace

struct BinPasses::Placed {
    Placed(Device& device, std::uint64_t count, std::uint64_t stoppedTexels, const SampleDensity& density)
        : positions(device, TexelFormat::rgba32f, count), radiances(device, TexelFormat::rgba32f, count),
          stopped(device, TexelFormat::r32ui, stoppedTexels),
          pixelSums(device, TexelFormat::r32ui, density.sums.size()), pairs(device, count) {
        pixelSums.upload(density.sums);
    }
    Buffer positions, radiances;
    Buffer stopped;    ///< rays that end before each block
    Buffer pixelSums;  ///< of SampleDensity
    PairBuffers pairs; ///< sort key, sample index
};

BinPasses::BinPasses(Device& device)
    : device_(device), place_(device, "bin_place"), occlude_(device, "bin_occlude"),
      gather_(device, "bin_gather"), bounds_(device, "bin_bounds"), bricks_(device, "bin_bricks"),
      cells_(device, "bin_cells") {}

void BinPasses::place(CommandList& commands, const LightField& field, BinPush push, Placed& placed) {
    const std::size_t part = std::min(kUploadSamples, field.samples.size());
    Buffer upload(device_, TexelFormat::rgba32f, part * kTexelsPerSample);
    for (std::size_t first = 0; first < field.samples.size(); first += part) {
        push.firstSample = uint(first);
        push.count = uint(std::min(part, field.samples.size() - first));
        upload.upload(std::span(field.samples).subspan(first, push.count));
        commands.dispatch(place_,
                          {upload, placed.positions, placed.radiances, placed.pairs.keys, placed.pairs.values,
                           placed.pixelSums},
                          push, place_.gridFor(push.count));
        commands.dispatch(occlude_, {upload, placed.stopped}, push, occlude_.gridFor(push.count));
        commands.run();
    }
}

DeviceBins BinPasses::run(CommandList& commands, const LightField& field, const BinScope& scope) {
    const SampleDensity density = densityOf(field);
    BinPush push{};
    push.grid = chooseGrid(field, density, scope);
    push.occlusion = chooseOcclusion(push.grid, density);
    push.density = density.layout;
    push.regionMin = ivec2(scope.region.x0, scope.region.y0);
    push.regionMax = ivec2(scope.region.x1, scope.region.y1);
    push.marginPx = marginPx(scope, density);

    Placed placed(device_, field.samples.size(), stoppedBlocks(push.occlusion), density);
    commands.fill(placed.stopped, 0);
    place(commands, field, push, placed);

    const GridLayout& grid = push.grid;
    const std::uint64_t kept = grid.sampleCount,
                        cellsPerBrick = std::uint64_t(grid.cellsPerBrick) * grid.cellsPerBrick;
    const std::uint64_t keyCount =
        std::uint64_t(grid.brickCount.x) * grid.brickCount.y * grid.bucketCount * cellsPerBrick;
    PairBuffers scratch(device_, field.samples.size());
    const RadixSort sort(device_, field.samples.size());
    // One key more than there are cells: kNotBinned sorts behind them all.
    const bool inScratch = &sort.record(commands, placed.pairs, scratch, field.samples.size(),
                                        std::bit_width(keyCount)) == &scratch;
    PairBuffers& sorted = inScratch ? scratch : placed.pairs;

    Buffer positions(device_, TexelFormat::rgba32f, kept), radiances(device_, TexelFormat::rgba32f, kept);
    Buffer brickOfRecord(device_, TexelFormat::r32ui, kept + 1);
    push.count = uint(kept);
    commands.dispatch(gather_,
                      {sorted.keys, sorted.values, placed.positions, placed.radiances, positions, radiances,
                       brickOfRecord, placed.stopped},
                      push, gather_.gridFor(kept + 1));
    const Scan scan(device_, kept + 1);
    scan.record(commands, brickOfRecord, kept + 1);
    commands.run();
    push.brickTotal = lastWord(brickOfRecord);

    Buffer bounds(device_, TexelFormat::r32ui, push.brickTotal * std::uint64_t(kBoundWords));
    Buffer brickKeys(device_, TexelFormat::r32ui, push.brickTotal);
    commands.fill(bounds, 0xffffffffu);
    commands.dispatch(bounds_, {sorted.keys, positions, brickOfRecord, bounds, brickKeys, radiances}, push,
                      bounds_.gridFor(kept));
    Buffer bricks(device_, TexelFormat::rgba32ui, push.brickTotal),
        cellBases(device_, TexelFormat::r32ui, push.brickTotal);
    push.count = push.brickTotal;
    commands.dispatch(bricks_, {brickKeys, bounds, bricks, cellBases}, push, bricks_.gridFor(push.count));
    Buffer cellStart(device_, TexelFormat::r32ui, push.brickTotal * cellsPerBrick + 1);
    commands.dispatch(
        cells_, {sorted.keys, brickKeys, cellStart}, push,
        cells_.gridFor(std::max<std::uint64_t>(1, push.brickTotal * std::uint64_t(grid.cellsPerBrick))));
    commands.run();
    return {grid,
            push.brickTotal,
            std::move(positions),
            std::move(radiances),
            std::move(cellStart),
            std::move(bricks),
            std::move(cellBases),
            std::move(sorted.values)};
}

} // namespace slant

#include "compute/bin_passes.h"

#include "compute/lens_buffer.h"
#include "reconstruct/occlusion.h"

#include <algorithm>

namespace slant {
namespace {

/// Samples uploaded at a time: 32 MiB.
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
        : positions(device, TexelFormat::rgba32f, count), stopped(device, TexelFormat::r32ui, stoppedTexels),
          pixelSums(device, TexelFormat::r32ui, density.sums.size()), pairs(device, count) {
        pixelSums.upload(density.sums);
    }
    Buffer positions;
    Buffer stopped;    ///< rays that end before each block
    Buffer pixelSums;  ///< of SampleDensity
    PairBuffers pairs; ///< sort key, sample index
};

BinPasses::BinPasses(Device& device)
    : device_(device), place_(device, "bin_place"), occlude_(device, "bin_occlude"),
      bounds_(device, "bin_bounds"), bricks_(device, "bin_bricks"), cells_(device, "bin_cells") {}

void BinPasses::place(CommandList& commands, std::span<const LightFieldSample> samples, BinPush push,
                      Placed& placed) {
    const std::size_t part = std::min(kUploadSamples, samples.size());
    Buffer upload(device_, TexelFormat::rgba32f, part * kTexelsPerSample);
    for (std::size_t first = 0; first < samples.size(); first += part) {
        push.firstSample = uint(first);
        push.count = uint(std::min(part, samples.size() - first));
        upload.upload(samples.subspan(first, push.count));
        commands.dispatch(
            place_, {upload, placed.positions, placed.pairs.keys, placed.pairs.values, placed.pixelSums},
            push, place_.gridFor(push.count));
        commands.dispatch(occlude_, {upload, placed.stopped}, push, occlude_.gridFor(push.count));
        commands.run();
    }
}

DeviceBins BinPasses::run(CommandList& commands, const SceneSideSamples& source, const BinScope& scope) {
    const SampleDensity density = densityOf(source);
    const std::span<const LightFieldSample> samples = source.samples();
    BinPush push{};
    push.grid = chooseGrid(samples, density, scope);
    push.occlusion = chooseOcclusion(push.grid, density);
    push.density = density.layout;
    push.regionMin = ivec2(scope.region.x0, scope.region.y0);
    push.regionMax = ivec2(scope.region.x1, scope.region.y1);
    push.marginPx = marginPx(scope, density);

    Placed placed(device_, samples.size(), stoppedBlocks(push.occlusion), density);
    commands.fill(placed.stopped, 0);
    place(commands, samples, push, placed);

    const GridLayout& grid = push.grid;
    const std::uint64_t kept = grid.sampleCount,
                        cellsPerBrick = std::uint64_t(grid.cellsPerBrick) * grid.cellsPerBrick;
    const std::uint64_t keyCount =
        std::uint64_t(grid.brickCount.x) * grid.brickCount.y * grid.bucketCount * cellsPerBrick;
    PairBuffers scratch(device_, samples.size());
    const RadixSort sort(device_, samples.size());
    // One key more than there are cells: kNotBinned sorts after them all.
    const bool inScratch =
        &sort.record(commands, placed.pairs, scratch, samples.size(), std::bit_width(keyCount)) == &scratch;
    PairBuffers& sorted = inScratch ? scratch : placed.pairs;

    Buffer positions(device_, TexelFormat::rgba32f, kept), values(device_, TexelFormat::rgba32f, kept);
    Buffer brickOfRecord(device_, TexelFormat::r32ui, kept + 1);
    push.count = uint(kept);
    Buffer areaExcess(device_, TexelFormat::r32f, source.areaExcess().size());
    areaExcess.upload(source.areaExcess());
    const Pass gather(device_, "bin_gather", compoundLens(!source.areaExcess().empty()));
    commands.dispatch(gather,
                      {sorted.keys, sorted.values, placed.positions, areaExcess, positions, values,
                       brickOfRecord, placed.stopped},
                      push, gather.gridFor(kept + 1));
    const Scan scan(device_, kept + 1);
    scan.record(commands, brickOfRecord, kept + 1);
    commands.run();
    push.brickTotal = lastWord(brickOfRecord);

    Buffer bounds(device_, TexelFormat::r32ui, push.brickTotal * std::uint64_t(kBoundWords));
    Buffer brickKeys(device_, TexelFormat::r32ui, push.brickTotal);
    commands.fill(bounds, 0xffffffffu);
    commands.dispatch(bounds_, {sorted.keys, positions, brickOfRecord, bounds, brickKeys, values}, push,
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
            std::move(values),
            std::move(cellStart),
            std::move(bricks),
            std::move(cellBases),
            std::move(sorted.values)};
}

} // namespace slant

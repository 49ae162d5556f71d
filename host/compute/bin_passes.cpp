#include "compute/bin_passes.h"

#include "compute/field_buffers.h"
#include "reconstruct/occlusion.h"
#include "reconstruct/points.h"

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
    Placed(Device& device, std::uint64_t count, std::uint64_t stoppedTexels, const SampleDensity& density,
           const MotionGrid& motion)
        : positions(device, TexelFormat::rgba32f, count), stopped(device, TexelFormat::r32ui, stoppedTexels),
          pixelSums(device, TexelFormat::r32ui, density.sums.size()), pairs(device, count),
          motions(device, TexelFormat::rgba32f, motion.moves() ? count * kPlacedMotionTexels : 0),
          layers(device, TexelFormat::r32ui, motion.layers.size()),
          motionTexels(motionBuffer(device, motion.layout)) {
        pixelSums.upload(density.sums);
        layers.upload(motion.layers);
    }
    Buffer positions;
    Buffer stopped;      ///< rays that end before each block
    Buffer pixelSums;    ///< of SampleDensity
    PairBuffers pairs;   ///< sort key, sample index
    Buffer motions;      ///< kPlacedMotionTexels per sample
    Buffer layers;       ///< of MotionGrid
    Buffer motionTexels; ///< MotionLayout
};

BinPasses::BinPasses(Device& device, bool compoundLens, bool moves)
    : device_(device), place_(device, "bin_place", fieldConstants(compoundLens, moves)),
      occlude_(device, "bin_occlude", fieldConstants(compoundLens, moves)),
      gather_(device, "bin_gather", fieldConstants(compoundLens, moves)),
      bounds_(device, "bin_bounds", fieldConstants(compoundLens, moves)),
      bricks_(device, "bin_bricks", fieldConstants(compoundLens, moves)), cells_(device, "bin_cells") {}

void BinPasses::place(CommandList& commands, const SceneSideSamples& source, BinPush push, Placed& placed) {
    const std::span<const LightFieldSample> samples = source.samples();
    const Points points(source);
    const std::size_t part = std::min(kUploadSamples, samples.size());
    Buffer upload(device_, TexelFormat::rgba32f, part * kTexelsPerSample);
    Buffer relative(device_, TexelFormat::rgba32f, points.move() ? part : 0);
    std::vector<vec4> relativeMotions;
    for (std::size_t first = 0; first < samples.size(); first += part) {
        push.firstSample = uint(first);
        push.count = uint(std::min(part, samples.size() - first));
        upload.upload(samples.subspan(first, push.count));
        if (points.move()) {
            relativeMotions.clear();
            for (std::size_t i = first; i < first + push.count; ++i)
                relativeMotions.push_back(points.relativeMotion(i));
            relative.upload(relativeMotions);
        }
        commands.dispatch(place_,
                          {upload, placed.positions, placed.pairs.keys, placed.pairs.values, placed.pixelSums,
                           relative, placed.layers, placed.motionTexels, placed.motions},
                          push, place_.gridFor(push.count));
        commands.dispatch(occlude_, {upload, placed.stopped, relative, placed.motionTexels}, push,
                          occlude_.gridFor(push.count));
        commands.run();
    }
}

DeviceBins BinPasses::run(CommandList& commands, const SceneSideSamples& source, const BinScope& scope) {
    const SampleDensity density = densityOf(source);
    const std::span<const LightFieldSample> samples = source.samples();
    BinPush push{};
    push.grid = chooseGrid(source, density, scope);
    MotionGrid motion = chooseMotionGrid(source, push.grid, density, scope);
    push.occlusion = chooseOcclusion(push.grid, density, motion);
    push.density = density.layout;
    push.regionMin = ivec2(scope.region.x0, scope.region.y0);
    push.regionMax = ivec2(scope.region.x1, scope.region.y1);
    push.marginPx = marginPx(scope, density);

    Placed placed(device_, samples.size(), stoppedBlocks(push.occlusion, motion), density, motion);
    commands.fill(placed.stopped, 0);
    place(commands, source, push, placed);

    const GridLayout& grid = push.grid;
    const std::uint64_t kept = grid.sampleCount,
                        cellsPerBrick = std::uint64_t(grid.cellsPerBrick) * grid.cellsPerBrick;
    const std::uint64_t layers = motion.moves() ? motion.layerCount : uint(grid.bucketCount);
    const std::uint64_t keyCount =
        std::uint64_t(grid.brickCount.x) * grid.brickCount.y * layers * cellsPerBrick;
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
    Buffer motions(device_, TexelFormat::rgba32f, motion.moves() ? kept : 0);
    commands.dispatch(gather_,
                      {sorted.keys, sorted.values, placed.positions, areaExcess, positions, values,
                       brickOfRecord, placed.stopped, placed.motions, placed.motionTexels, motions},
                      push, gather_.gridFor(kept + 1));
    const Scan scan(device_, kept + 1);
    scan.record(commands, brickOfRecord, kept + 1);
    commands.run();
    push.brickTotal = lastWord(brickOfRecord);

    const std::uint64_t boundWords = motion.moves() ? kBoundWords + kMotionBoundWords : kBoundWords;
    Buffer bounds(device_, TexelFormat::r32ui, push.brickTotal * boundWords);
    Buffer brickKeys(device_, TexelFormat::r32ui, push.brickTotal);
    commands.fill(bounds, 0xffffffffu);
    commands.dispatch(
        bounds_,
        {sorted.keys, positions, brickOfRecord, bounds, brickKeys, values, sorted.values, placed.motions},
        push, bounds_.gridFor(kept));
    const std::uint64_t movingBricks = motion.moves() ? push.brickTotal : 0;
    Buffer brickMotions(device_, TexelFormat::rgba32f, movingBricks * kBrickMotionTexels),
        brickRanks(device_, TexelFormat::r32f, 2 * movingBricks);
    Buffer bricks(device_, TexelFormat::rgba32ui, push.brickTotal),
        cellBases(device_, TexelFormat::r32ui, push.brickTotal);
    push.count = push.brickTotal;
    commands.dispatch(bricks_, {brickKeys, bounds, bricks, cellBases, brickMotions, brickRanks}, push,
                      bricks_.gridFor(push.count));
    Buffer cellStart(device_, TexelFormat::r32ui, push.brickTotal * cellsPerBrick + 1);
    commands.dispatch(
        cells_, {sorted.keys, brickKeys, cellStart}, push,
        cells_.gridFor(std::max<std::uint64_t>(1, push.brickTotal * std::uint64_t(grid.cellsPerBrick))));
    commands.run();
    std::vector<vec2> ranks(movingBricks);
    brickRanks.download(ranks);
    return {grid,
            push.brickTotal,
            std::move(positions),
            std::move(values),
            std::move(cellStart),
            std::move(bricks),
            std::move(cellBases),
            std::move(sorted.values),
            std::move(motion),
            std::move(motions),
            std::move(brickMotions),
            std::move(ranks)};
}

} // namespace slant

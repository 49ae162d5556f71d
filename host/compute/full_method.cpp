// Methods `full` and `auto` on the device: outputs from the bins, with apparent surfaces told apart; of
// `auto`, only those that the layer map cannot serve.
#include "compute/compute_methods.h"
#include "compute/map_passes.h"
#include "compute/output_passes.h"
#include "reconstruct/cpu_chunk.h"
#include "reconstruct/stage_timer.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <optional>

namespace slant {
namespace {

class FullMethod {
public:
    explicit FullMethod(ComputeRun& run)
        : run_(run), bins_(run.bins()),
          pattern_(makeOutputPattern(run.options.outputsPerPixel, largestSlope(bins_.grid),
                                     run.options.lensScale, apertureOf(run.field, run.options))),
          listPasses_(run.device, pattern_, run.field.lensMap),
          outputPasses_(run.device, pattern_, run.field.lensMap) {
        if (usesLayers(run.field, run.options.method)) mapPasses_.emplace(run.device, pattern_);
    }

    void fill() {
        const Rect& frame = run_.field.frame;
        const float reach = mapReach(bins_.grid, run_.options.lensScale);
        const int texels = mapTexelsPerPixel(run_.field);
        const int maxRows = mapPasses_ ? mapRows(frame, texels, reach, run_.options.memoryBytes / 2)
                                       : std::numeric_limits<int>::max();
        const Plan plan = planOutputs(frame, run_.film.filter(), pattern_, run_.maxSamples, maxRows);
        const int groupSize = pattern_.groupSize();
        Buffer dense(run_.device, TexelFormat::rgba32f,
                     plan.bands.front().region.area() * std::uint64_t(plan.groupsPerChunk * groupSize));

        run_.monitor.beginStage("reconstruct", plan.outputs, "outputs");
        for (const Band& band : plan.bands) {
            if (mapPasses_) makeMap(chooseMap(bins_.grid, band.region, texels, reach, spreadPerPx(pattern_)));
            for (int group = 0; group < int(pattern_.groups.size()); group += plan.groupsPerChunk) {
                OutputPush push{};
                push.grid = bins_.grid;
                push.outputs = layoutOf(band, pattern_, run_.options.seed);
                push.lensCells = pattern_.lensCells;
                push.lensScale = pattern_.lensScale;
                push.firstGroup = uint(group);
                push.groupCount = uint(std::min(plan.groupsPerChunk, int(pattern_.groups.size()) - group));
                push.firstOutput = group * groupSize;
                push.brickTotal = bins_.brickTotal;
                push.groupBits = pattern_.groupBits;
                push.takenBits = pattern_.sparseBits;
                chunk(band, push, int(push.groupCount) * groupSize, dense);
            }
        }
        run_.monitor.endStage();
    }

private:
    void makeMap(const MapLayout& layout) {
        StageTimer timer(run_.report, "layer_map", "texels");
        mapPasses_->makeMap(run_.commands, bins_, layout, [&](ivec2 texel) {
            const Bins& bins = run_.binsOnCpu();
            std::vector<uint> bricks(bins.bricks.size());
            std::iota(bricks.begin(), bricks.end(), 0u);
            return resolveTexel({bins, bricks}, layout, texel);
        });
        timer.items = mapPasses_->texels().texels();
        timer.bytes = run_.device.peakBytes();
        run_.observe("layer_map", mapPasses_->texels());
    }

    /// How many outputs of a chunk are made, and the lists that are left to be searched for in the bins.
    struct Work {
        OutputPasses::Left left;
        std::uint64_t outputs = 0, fromMap = 0;
    };
    /// Takes what the layer map serves of a chunk, if there is one; of each list, `missed` gets the pixels
    /// that it does not serve.
    Work takeFromMap(const Band& band, const DeviceLists& lists, const OutputPush& push, const Buffer& missed,
                     const Buffer& dense) {
        ListClasses classes(lists.start.texels() - 1);
        if (mapPasses_) {
            const Buffer buffer(run_.device, TexelFormat::r32ui, classes.codes.size());
            if (run_.observer) run_.commands.fill(dense, 0); // planes that nobody reads
            mapPasses_->record(run_.commands, listPasses_, lists, outputPasses_.pattern(), push, buffer,
                               missed, dense);
            run_.commands.run();
            buffer.download(classes.codes);
            missed.download(classes.missed);
            run_.observe("list_classes", buffer);
            run_.observe("missed", missed);
            addMapShare(run_.report.mapShare, run_.field.frame, band, classes, pattern_.groups.size());
        } else {
            run_.commands.fill(missed, ~0u);
        }
        Work work;
        const ivec2 tiles = push.outputs.tileCount;
        for (uint list = 0; list < classes.codes.size(); ++list) {
            const uint tile = list % uint(tiles.x * tiles.y);
            const ivec2 place(tile % tiles.x, tile / tiles.x);
            const std::uint64_t inside = tilePixels(push.outputs.regionSize - kTileSize * place);
            const std::uint64_t missedInside = inside & classes.missedOf(list);
            const bool sparse = (classes.codes[list] & kSparseBit) != 0;
            const int bits = sparse ? pattern_.sparseBits : pattern_.groupBits;
            work.outputs += std::uint64_t(std::popcount(inside)) << bits;
            work.fromMap += std::uint64_t(std::popcount(inside & ~missedInside)) << bits;
            if (missedInside != 0)
                (sparse ? work.left.sparse : work.left.whole)
                    .emplace_back(place.x, place.y, list / uint(tiles.x * tiles.y), list);
        }
        return work;
    }

    void chunk(const Band& band, const OutputPush& push, int planes, Buffer& dense) {
        const std::uint64_t samples = band.region.area() * std::uint64_t(planes);
        ReconstructReport& report = run_.report;
        {
            StageTimer timer(report, "reconstruct", "outputs");
            const DeviceLists lists = listPasses_.run(run_.commands, bins_, push, 2 * bins_.grid.radiusPx);
            if (run_.observer && !run_.field.lensMap.empty()) {
                const std::vector<float>& bounds = listPasses_.lensBounds();
                run_.observer->stage("lists.lens",
                                     {reinterpret_cast<const uint*>(bounds.data()), bounds.size()});
            }
            run_.observe("lists.start", lists.start);
            run_.observe("lists.bricks", lists.ids);
            const Buffer missed(run_.device, TexelFormat::r32ui, 2 * (lists.start.texels() - 1));
            const Work work = takeFromMap(band, lists, push, missed, dense);
            const OutputPasses::Result result =
                outputPasses_.run(run_.commands, listPasses_, bins_, lists, work.left, missed, push, dense);
            if (!result.overflowed.empty()) finishOnCpu(band, push, result.overflowed, dense);
            report.fromMap += work.fromMap;
            report.visibility += result.visibility;
            report.widened += result.widened;
            report.holes += result.holes;
            report.overflowed += result.overflowed.size();
            report.outputs += timer.items = work.outputs;
            timer.bytes = run_.device.peakBytes();
            run_.observe("dense", dense, samples);
        }
        StageTimer timer(report, "pixel_filter", "outputs");
        timer.items = samples;
        run_.filmPass.accumulate(run_.commands, dense, band, planes, pattern_.groupSize());
        run_.monitor.advance(samples);
    }

    /// The outputs with more candidates than a shader may loop over.
    void finishOnCpu(const Band& band, const OutputPush& push, const std::vector<uint>& indices,
                     Buffer& dense) {
        CpuChunk cpu(run_.binsOnCpu(), nullptr, run_.field.lensMap, pattern_, band, run_.options.seed,
                     push.firstGroup, push.groupCount);
        cpu.redo(indices, run_.report);
        for (const uint index : indices)
            dense.upload(std::span<const vec4>(&cpu.dense.samples[index], 1), index);
    }

    ComputeRun& run_;
    const DeviceBins& bins_;
    OutputPattern pattern_;
    ListPasses listPasses_;
    OutputPasses outputPasses_;
    std::optional<MapPasses> mapPasses_;
};

} // namespace

void fullMethod(ComputeRun& run) {
    FullMethod(run).fill();
}

} // namespace slant

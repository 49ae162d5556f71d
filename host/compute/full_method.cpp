// Method `full` on the device: every output from the bins, with apparent surfaces told apart.
#include "compute/compute_methods.h"
#include "compute/output_passes.h"
#include "reconstruct/cpu_chunk.h"
#include "reconstruct/stage_timer.h"

#include <algorithm>
#include <optional>

namespace slant {
namespace {

class FullMethod {
public:
    explicit FullMethod(ComputeRun& run)
        : run_(run), bins_(run.bin()),
          pattern_(makeOutputPattern(run.options.outputsPerPixel, largestSlope(bins_.grid),
                                     run.options.lensScale)),
          listPasses_(run.device, pattern_), outputPasses_(run.device, pattern_) {}

    void fill() {
        const Plan plan = planOutputs(run_.field.frame, run_.film.filter(), pattern_, run_.maxSamples);
        const int groupSize = pattern_.groupSize();
        Buffer dense(run_.device, TexelFormat::rgba32f,
                     plan.bands.front().region.area() * std::uint64_t(plan.groupsPerChunk * groupSize));

        run_.monitor.beginStage("reconstruct", plan.outputs, "outputs");
        for (const Band& band : plan.bands)
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
                chunk(band, push, int(push.groupCount) * groupSize, dense);
            }
        run_.monitor.endStage();
    }

private:
    void chunk(const Band& band, const OutputPush& push, int planes, Buffer& dense) {
        const std::uint64_t samples = band.region.area() * std::uint64_t(planes);
        ReconstructReport& report = run_.report;
        {
            StageTimer timer(report, "reconstruct", "outputs");
            const DeviceLists lists = listPasses_.run(run_.commands, bins_, push, 2 * bins_.grid.radiusPx);
            const OutputPasses::Result result =
                outputPasses_.run(run_.commands, listPasses_, bins_, lists, push, dense);
            if (!result.overflowed.empty()) finishOnCpu(band, push, result.overflowed, dense);
            report.visibility += result.visibility;
            report.widened += result.widened;
            report.holes += result.holes;
            report.overflowed += result.overflowed.size();
            report.outputs += timer.items = samples;
            timer.bytes = run_.device.peakBytes();
            run_.observe("lists.start", lists.start);
            run_.observe("lists.bricks", lists.ids);
            run_.observe("dense", dense, samples);
        }
        StageTimer timer(report, "pixel_filter", "outputs");
        timer.items = samples;
        run_.filmPass.accumulate(run_.commands, dense, band, planes);
        run_.monitor.advance(samples);
    }

    /// The outputs with more candidates than a shader may loop over.
    void finishOnCpu(const Band& band, const OutputPush& push, const std::vector<uint>& indices,
                     Buffer& dense) {
        const LightField& field = run_.field;
        if (!cpuBins_)
            cpuBins_ = binSamples(field, outputRegion(field.frame, run_.film.filter()),
                                  kSearchRadii * emptyCircleRadius(field.samplesPerPixel));
        CpuChunk cpu(*cpuBins_, pattern_, band, run_.options.seed, push.firstGroup, push.groupCount);
        cpu.redo(indices, run_.report);
        for (const uint index : indices)
            dense.upload(std::span<const vec4>(&cpu.dense.samples[index], 1), index);
    }

    ComputeRun& run_;
    DeviceBins bins_;
    OutputPattern pattern_;
    ListPasses listPasses_;
    OutputPasses outputPasses_;
    std::optional<Bins> cpuBins_;
};

} // namespace

void fullMethod(ComputeRun& run) {
    FullMethod(run).fill();
}

} // namespace slant

// Method `window` on the device: every output from a fixed window of pixels.
#include "compute/compute_methods.h"
#include "compute/lens_buffer.h"
#include "reconstruct/stage_timer.h"
#include "reconstruct/window_chunk.h"

#include <algorithm>
#include <numeric>

namespace slant {
namespace {

Buffer uploaded(Device& device, const std::vector<vec4>& texels) {
    Buffer buffer(device, TexelFormat::rgba32f, texels.size());
    buffer.upload(std::span(texels));
    return buffer;
}

class WindowMethod {
public:
    explicit WindowMethod(ComputeRun& run)
        : run_(run), samples_(windowSamples(run.field)), search_(windowSearch(run.field, run.options.window)),
          pattern_(makeOutputPattern(run.options.outputsPerPixel, 0, run.options.lensScale,
                                     apertureOf(run.field, run.options))),
          pass_(run.device, "window", compoundLens(run.field.lensMap)),
          positions_(uploaded(run.device, samples_.positions)),
          radiances_(uploaded(run.device, samples_.radiances)),
          pixelStart_(run.device, TexelFormat::r32ui, samples_.pixelStart.size()),
          entries_(run.device, TexelFormat::rgba32ui, pattern_.entries.size()),
          aperture_(run.device, TexelFormat::r32f, pattern_.aperture.table().size()),
          lensMap_(lensBuffer(run.device, run.field.lensMap)),
          counters_(run.device, TexelFormat::r32ui, kCounters),
          plan_(planOutputs(run.field.frame, run.film.filter(), pattern_, run.maxSamples)),
          dense_(run.device, TexelFormat::rgba32f, mostSamples()),
          overflowList_(run.device, TexelFormat::r32ui, mostSamples()) {
        pixelStart_.upload(samples_.pixelStart);
        entries_.upload(std::span(pattern_.entries));
        aperture_.upload(pattern_.aperture.table());
    }

    void fill() {
        run_.observe("window.positions", positions_);
        run_.observe("window.radiances", radiances_);
        run_.monitor.beginStage("reconstruct", plan_.outputs, "outputs");
        for (const Band& band : plan_.bands)
            for (int group = 0; group < int(pattern_.groups.size()); group += plan_.groupsPerChunk)
                chunk(band, group, std::min(plan_.groupsPerChunk, int(pattern_.groups.size()) - group));
        run_.monitor.endStage();
        warnOfHoles(run_.report, run_.monitor);
    }

private:
    std::uint64_t mostSamples() const {
        return plan_.bands.front().region.area() * std::uint64_t(plan_.groupsPerChunk << pattern_.groupBits);
    }

    void chunk(const Band& band, int firstGroup, int groupCount) {
        const int planes = groupCount << pattern_.groupBits;
        const std::uint64_t samples = band.region.area() * std::uint64_t(planes);
        {
            StageTimer timer(run_.report, "reconstruct", "outputs");
            WindowPush push{};
            push.search = search_;
            push.outputs = layoutOf(band, pattern_, run_.options.seed);
            push.lensCells = pattern_.lensCells;
            push.lensScale = pattern_.lensScale;
            push.firstOutput = firstGroup << pattern_.groupBits;
            push.count = uint(samples);
            const std::vector<uint> overflowed = look(push);
            if (!overflowed.empty()) finishOnCpu(band, firstGroup, groupCount, overflowed);
            run_.report.overflowed += overflowed.size();
            run_.report.outputs += timer.items = samples;
            timer.bytes = run_.device.peakBytes();
            run_.observe("dense", dense_, samples);
        }
        StageTimer timer(run_.report, "pixel_filter", "outputs");
        timer.items = samples;
        run_.filmPass.accumulate(run_.commands, dense_, band, planes, 1);
        run_.monitor.advance(samples);
    }

    /// Returns the outputs that are left to the CPU, ascending.
    std::vector<uint> look(const WindowPush& push) {
        if (windowSteps(run_.field, search_) > std::uint64_t(kMaxWindowSteps)) {
            std::vector<uint> all(push.count);
            std::iota(all.begin(), all.end(), 0u);
            return all;
        }
        run_.commands.fill(counters_, 0);
        run_.commands.dispatch(pass_,
                               {positions_, radiances_, entries_, dense_, counters_, overflowList_, aperture_,
                                pixelStart_, lensMap_},
                               push, pass_.gridFor(push.count));
        run_.commands.run();
        std::vector<uint> counts(kCounters);
        counters_.download(std::span(counts));
        run_.report.visibility += counts[kVisibilityCount];
        run_.report.widened += counts[kFilledCount];
        run_.report.holes += counts[kHoleCount];
        std::vector<uint> overflowed(counts[kOverflowCount]);
        overflowList_.download(std::span(overflowed));
        std::sort(overflowed.begin(), overflowed.end());
        return overflowed;
    }

    void finishOnCpu(const Band& band, int firstGroup, int groupCount, const std::vector<uint>& indices) {
        WindowChunk cpu(samples_, search_, run_.field.lensMap, pattern_, band, run_.options.seed,
                        std::size_t(firstGroup), std::size_t(groupCount));
        cpu.redo(indices, run_.report);
        if (indices.size() == cpu.dense.samples.size()) {
            dense_.upload(std::span<const vec4>(cpu.dense.samples));
            return;
        }
        for (const uint index : indices)
            dense_.upload(std::span<const vec4>(&cpu.dense.samples[index], 1), index);
    }

    ComputeRun& run_;
    WindowSamples samples_;
    WindowSearch search_;
    OutputPattern pattern_;
    Pass pass_;
    Buffer positions_, radiances_, pixelStart_, entries_, aperture_, lensMap_, counters_;
    Plan plan_;
    Buffer dense_, overflowList_;
};

} // namespace

void windowMethod(ComputeRun& run) {
    WindowMethod(run).fill();
}

} // namespace slant

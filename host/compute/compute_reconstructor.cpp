#include "compute/compute_reconstructor.h"

#include "compute/output_passes.h"
#include "reconstruct/cpu_chunk.h"
#include "reconstruct/stage_timer.h"

#include <algorithm>
#include <optional>

namespace slant {
namespace {

/// Words of a buffer's first texels for the observer.
void observe(StageObserver* observer, const char* name, const Buffer& buffer, std::uint64_t texels) {
    if (!observer) return;
    std::vector<uint> words(texels * texelBytes(buffer.format()) / sizeof(uint));
    buffer.download(std::span(words));
    observer->stage(name, words);
}

void observe(StageObserver* observer, const char* name, const Buffer& buffer) {
    observe(observer, name, buffer, buffer.texels());
}

/// The film on the device, and the pass that fills it.
class FilmPass {
public:
    FilmPass(Device& device, const FilmBuffer& film)
        : pass_(device, "pixel_filter"), table_(film.filter()), frame_(film.frame()),
          weights_(device, TexelFormat::r32f, table_.weights.size()),
          sums_(device, TexelFormat::rgba32f, film.sums().size()) {
        weights_.upload(std::span<const float>(table_.weights));
        sums_.upload(std::span<const vec4>(film.sums()));
    }

    void accumulate(CommandList& commands, const Buffer& dense, const Band& band, int planes) {
        FilterPush push{};
        push.regionSize = ivec2(band.region.width(), band.region.height());
        push.reach = table_.reach;
        push.tableLength = table_.length;
        push.filmSize = ivec2(frame_.width(), frame_.height());
        push.firstRow = band.y0 - frame_.y0;
        push.rowCount = band.y1 - band.y0;
        const int taps = (2 * table_.reach.x + 1) * (2 * table_.reach.y + 2);
        const int most = std::max(1, kMaxLoopIterations / (taps * kFilmBlock)) * kFilmBlock;
        for (int first = 0; first < planes; first += most) {
            push.firstPlane = first;
            push.planeCount = std::min(most, planes - first);
            commands.dispatch(pass_, {dense, weights_, sums_}, push,
                              pass_.gridOver(std::uint32_t(frame_.width()), std::uint32_t(push.rowCount)));
        }
        commands.run();
    }

    void download(FilmBuffer& film) const { sums_.download(std::span(film.sums())); }

private:
    Pass pass_;
    FilterTable table_;
    Rect frame_;
    Buffer weights_, sums_;
};

/// One reconstruction.
class Run {
public:
    Run(Device& device, const LightField& field, const ReconstructOptions& options, Monitor& monitor,
        ReconstructReport& report, StageObserver* observer)
        : device_(device), field_(field), options_(options), monitor_(monitor), report_(report),
          observer_(observer), commands_(device), film_(field.frame, makeFilterTable(options.filter)),
          filmPass_(device, film_),
          maxSamples_(std::min(maxDenseSamples(options), device.limits().texelBufferElements)) {}

    Image run() {
        device_.resetPeakBytes();
        if (options_.method == Method::box)
            box();
        else
            full();
        filmPass_.download(film_);
        if (observer_)
            observer_->stage("film",
                             {reinterpret_cast<const uint*>(film_.sums().data()), 4 * film_.sums().size()});
        for (const PassTime& time : commands_.passTimes()) {
            StageStats& stage = report_.stage(("pass " + time.name).c_str(), "dispatches");
            stage.deviceSeconds = time.seconds;
            stage.items = time.dispatches;
        }
        return film_.toImage(report_.emptyPixels);
    }

private:
    void box() {
        StageTimer timer(report_, "pixel_filter", "samples");
        timer.items = field_.samples.size();
        for (const Band& band :
             planBands(field_.frame, film_.filter(), field_.samplesPerPixel, maxSamples_)) {
            const DenseSamples samples = denseFromInput(field_, band.region);
            Buffer dense(device_, TexelFormat::rgba32f, samples.samples.size());
            dense.upload(std::span<const vec4>(samples.samples));
            observe(observer_, "dense", dense);
            filmPass_.accumulate(commands_, dense, band, field_.samplesPerPixel);
        }
        timer.bytes = device_.peakBytes();
    }

    void full() {
        const DeviceBins bins = bin();
        const OutputPattern pattern = makeOutputPattern(options_.outputsPerPixel, largestSlope(bins.grid));
        const Plan plan = planOutputs(field_.frame, film_.filter(), pattern, maxSamples_);
        ListPasses listPasses(device_, pattern);
        OutputPasses outputPasses(device_, pattern);
        const int groupSize = pattern.groupSize();
        Buffer dense(device_, TexelFormat::rgba32f,
                     plan.bands.front().region.area() * std::uint64_t(plan.groupsPerChunk * groupSize));

        monitor_.beginStage("reconstruct", plan.outputs, "outputs");
        for (const Band& band : plan.bands)
            for (int group = 0; group < int(pattern.groups.size()); group += plan.groupsPerChunk) {
                OutputPush push{};
                push.grid = bins.grid;
                push.outputs = layoutOf(band, pattern, options_.seed);
                push.lensCells = pattern.lensCells;
                push.firstGroup = uint(group);
                push.groupCount = uint(std::min(plan.groupsPerChunk, int(pattern.groups.size()) - group));
                push.firstOutput = group * groupSize;
                push.brickTotal = bins.brickTotal;
                push.groupBits = pattern.groupBits;
                chunk(pattern, band, bins, listPasses, outputPasses, push, int(push.groupCount) * groupSize,
                      dense);
            }
        monitor_.endStage();
    }

    DeviceBins bin() {
        StageTimer timer(report_, "bin", "samples");
        timer.items = field_.samples.size();
        DeviceBins bins =
            BinPasses(device_).run(commands_, field_, outputRegion(field_.frame, film_.filter()),
                                   kSearchRadii * emptyCircleRadius(field_.samplesPerPixel));
        timer.bytes = device_.peakBytes();
        observe(observer_, "bin.bricks", bins.bricks);
        observe(observer_, "bin.cells", bins.cellStart);
        observe(observer_, "bin.positions", bins.positions);
        observe(observer_, "bin.radiances", bins.radiances);
        return bins;
    }

    void chunk(const OutputPattern& pattern, const Band& band, const DeviceBins& bins, ListPasses& listPasses,
               OutputPasses& outputPasses, const OutputPush& push, int planes, Buffer& dense) {
        const std::uint64_t samples = band.region.area() * std::uint64_t(planes);
        {
            StageTimer timer(report_, "reconstruct", "outputs");
            const DeviceLists lists = listPasses.run(commands_, bins, push, 2 * bins.grid.radiusPx);
            const OutputPasses::Result result =
                outputPasses.run(commands_, listPasses, bins, lists, push, dense);
            if (!result.overflowed.empty()) finishOnCpu(pattern, band, push, result.overflowed, dense);
            report_.visibility += result.visibility;
            report_.widened += result.widened;
            report_.holes += result.holes;
            report_.overflowed += result.overflowed.size();
            report_.outputs += timer.items = samples;
            timer.bytes = device_.peakBytes();
            observe(observer_, "lists.start", lists.start);
            observe(observer_, "lists.bricks", lists.ids);
            observe(observer_, "dense", dense, samples);
        }
        StageTimer timer(report_, "pixel_filter", "outputs");
        timer.items = samples;
        filmPass_.accumulate(commands_, dense, band, planes);
        monitor_.advance(samples);
    }

    /// The outputs with more candidates than a shader may loop over.
    void finishOnCpu(const OutputPattern& pattern, const Band& band, const OutputPush& push,
                     const std::vector<uint>& indices, Buffer& dense) {
        if (!cpuBins_)
            cpuBins_ = binSamples(field_, outputRegion(field_.frame, film_.filter()),
                                  kSearchRadii * emptyCircleRadius(field_.samplesPerPixel));
        CpuChunk cpu(*cpuBins_, pattern, band, options_.seed, push.firstGroup, push.groupCount);
        cpu.redo(indices, report_);
        for (const uint index : indices)
            dense.upload(std::span<const vec4>(&cpu.dense.samples[index], 1), index);
    }

    Device& device_;
    const LightField& field_;
    const ReconstructOptions& options_;
    Monitor& monitor_;
    ReconstructReport& report_;
    StageObserver* observer_;
    CommandList commands_;
    FilmBuffer film_;
    FilmPass filmPass_;
    std::uint64_t maxSamples_;
    std::optional<Bins> cpuBins_;
};

} // namespace

ComputeReconstructor::ComputeReconstructor(Device& device) : device_(device) {}
ComputeReconstructor::~ComputeReconstructor() = default;

Image ComputeReconstructor::reconstruct(const LightField& field, const ReconstructOptions& options,
                                        Monitor& monitor, ReconstructReport& report,
                                        StageObserver* observer) {
    return Run(device_, field, options, monitor, report, observer).run();
}

} // namespace slant

#include "compute/compute_reconstructor.h"

#include "compute/compute_methods.h"
#include "reconstruct/lens_tiles.h"
#include "reconstruct/stage_timer.h"

#include <array>

namespace slant {
namespace {

/// In the order of Method.
constexpr std::array<ComputeMethod*, kMethodCount> kMethods = {boxMethod, windowMethod, fullMethod,
                                                               fullMethod};

} // namespace

void ComputeRun::observe(const char* name, const Buffer& buffer, std::uint64_t texels) const {
    if (!observer) return;
    std::vector<uint> words(texels * texelBytes(buffer.format()) / sizeof(uint));
    buffer.download(std::span(words));
    observer->stage(name, words);
}

DeviceBins ComputeRun::bin() {
    StageTimer timer(report, "bin", "samples");
    timer.items = field.samples.size();
    DeviceBins bins = BinPasses(device).run(commands, field, searchRegionOf(field, film.filter()));
    timer.bytes = device.peakBytes();
    observe("bin.bricks", bins.bricks);
    observe("bin.cells", bins.cellStart);
    observe("bin.positions", bins.positions);
    observe("bin.radiances", bins.radiances);
    return bins;
}

ComputeReconstructor::ComputeReconstructor(Device& device) : device_(device) {}
ComputeReconstructor::~ComputeReconstructor() = default;

Image ComputeReconstructor::reconstruct(const LightField& field, const ReconstructOptions& options,
                                        Monitor& monitor, ReconstructReport& report,
                                        StageObserver* observer) {
    device_.resetPeakBytes();
    LightField scenic;
    const bool throughLens = usesOutputs(options.method) && !field.lensMap.empty();
    if (throughLens) scenic = onSceneSide(field);
    ComputeRun run{device_, throughLens ? scenic : field, options, monitor, report, observer};
    kMethods.at(std::size_t(options.method))(run);
    run.filmPass.download(run.film);
    if (observer)
        observer->stage("film",
                        {reinterpret_cast<const uint*>(run.film.sums().data()), 4 * run.film.sums().size()});
    for (const PassTime& time : run.commands.passTimes()) {
        StageStats& stage = report.stage(("pass " + time.name).c_str(), "dispatches");
        stage.deviceSeconds = time.seconds;
        stage.items = time.dispatches;
    }
    return run.film.toImage(report.emptyPixels);
}

} // namespace slant

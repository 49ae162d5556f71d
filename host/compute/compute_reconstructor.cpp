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

class ComputePreparedField final : public PreparedField {
public:
    ComputePreparedField(Device& device, const LightField& field, const ReconstructOptions& options)
        : device_(device), field_(field), options_(options) {
        if (compoundLens()) sceneSide_ = onSceneSide(field_);
    }

    Image picture(float slopeShift, Monitor& monitor, ReconstructReport& report,
                  IntermediateObserver* observer) override {
        checkFocus(options_, slopeShift);
        device_.resetPeakBytes();
        ComputeRun run{device_, seen(), options_, bins_, slopeShift, monitor, report, observer};
        kMethods.at(std::size_t(options_.method))(run);
        run.filmPass.download(run.film);
        if (observer)
            observer->stage(
                "film", {reinterpret_cast<const uint*>(run.film.sums().data()), 4 * run.film.sums().size()});
        for (const PassTime& time : run.commands.passTimes()) {
            StageStats& stage = report.stage(("pass " + time.name).c_str(), "dispatches");
            stage.deviceSeconds = time.seconds;
            stage.items = time.dispatches;
        }
        return run.film.toImage(report.emptyPixels);
    }

    void takeRadiances() override {
        if (compoundLens()) sceneSide_ = onSceneSide(field_);
        if (bins_.onDevice) {
            CommandList commands(device_);
            bins_.onDevice->takeRadiances(commands, seen());
        }
        if (bins_.onCpu) bins_.onCpu->takeRadiances(seen());
    }

private:
    bool compoundLens() const { return usesOutputs(options_.method) && !field_.lensMap.empty(); }
    const LightField& seen() const { return compoundLens() ? sceneSide_ : field_; }

    Device& device_;
    const LightField& field_;
    ReconstructOptions options_;
    LightField sceneSide_; ///< empty but through a lens
    ComputeBins bins_;
};

} // namespace

void ComputeRun::observe(const char* name, const Buffer& buffer, std::uint64_t texels) const {
    if (!observer) return;
    std::vector<uint> words(texels * texelBytes(buffer.format()) / sizeof(uint));
    buffer.download(std::span(words));
    observer->stage(name, words);
}

BinScope ComputeRun::binScope() const {
    return {searchRegionOf(field, film.filter()), options.anyFocus};
}

const DeviceBins& ComputeRun::bins() {
    if (!prepared.onDevice) {
        StageTimer timer(report, "bin", "samples");
        timer.items = field.samples.size();
        prepared.onDevice.emplace(device, commands, field, binScope());
        timer.bytes = device.peakBytes();
    }
    const DeviceBins& bins = [&]() -> const DeviceBins& {
        if (slopeShift == 0) return prepared.onDevice->at(commands, 0);
        StageTimer timer(report, "refocus", "samples");
        timer.items = field.samples.size();
        return prepared.onDevice->at(commands, slopeShift);
    }();
    observe("bin.bricks", bins.bricks);
    observe("bin.cells", bins.cellStart);
    observe("bin.positions", bins.positions);
    observe("bin.radiances", bins.radiances);
    return bins;
}

const Bins& ComputeRun::binsOnCpu() {
    if (!prepared.onCpu) prepared.onCpu.emplace(field, binScope());
    return prepared.onCpu->at(slopeShift);
}

std::unique_ptr<PreparedField> ComputeReconstructor::prepare(const LightField& field,
                                                             const ReconstructOptions& options) {
    return std::make_unique<ComputePreparedField>(device_, field, options);
}

} // namespace slant

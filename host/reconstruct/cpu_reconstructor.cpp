#include "reconstruct/cpu_reconstructor.h"

#include "reconstruct/cpu_methods.h"
#include "reconstruct/lens_tiles.h"
#include "reconstruct/stage_timer.h"

#include <array>

namespace slant {
namespace {

/// In the order of Method.
constexpr std::array<CpuMethod*, kMethodCount> kMethods = {boxMethod, windowMethod, fullMethod, fullMethod};

class CpuPreparedField final : public PreparedField {
public:
    CpuPreparedField(const LightField& field, const ReconstructOptions& options)
        : field_(field), options_(options) {
        if (compoundLens()) sceneSide_ = onSceneSide(field_);
    }

    Image picture(float slopeShift, Monitor& monitor, ReconstructReport& report,
                  IntermediateObserver* observer) override {
        checkFocus(options_, slopeShift);
        CpuRun run{seen(),  options_, bins_,    slopeShift,
                   monitor, report,   observer, FilmBuffer(field_.frame, makeFilterTable(options_.filter))};
        kMethods.at(std::size_t(options_.method))(run);
        run.observe("film", run.film.sums());
        return run.film.toImage(report.emptyPixels);
    }

    void takeRadiances() override {
        if (compoundLens()) sceneSide_ = onSceneSide(field_);
        if (bins_) bins_->takeRadiances(seen());
    }

private:
    bool compoundLens() const { return usesOutputs(options_.method) && !field_.lensMap.empty(); }
    const LightField& seen() const { return compoundLens() ? sceneSide_ : field_; }

    const LightField& field_;
    ReconstructOptions options_;
    LightField sceneSide_; ///< empty but through a lens
    std::optional<FocusedBins> bins_;
};

} // namespace

const Bins& CpuRun::bins() const {
    if (!prepared) {
        StageTimer timer(report, "bin", "samples");
        timer.items = field.samples.size();
        prepared.emplace(field, BinScope{searchRegionOf(field, film.filter()), options.anyFocus});
    }
    const Bins& bins = [&]() -> const Bins& {
        if (slopeShift == 0) return prepared->at(0);
        StageTimer timer(report, "refocus", "samples");
        timer.items = field.samples.size();
        return prepared->at(slopeShift);
    }();
    observe("bin.bricks", bins.bricks);
    observe("bin.cells", bins.cellStart);
    observe("bin.positions", bins.positions);
    observe("bin.radiances", bins.radiances);
    return bins;
}

std::unique_ptr<PreparedField> CpuReconstructor::prepare(const LightField& field,
                                                         const ReconstructOptions& options) {
    return std::make_unique<CpuPreparedField>(field, options);
}

} // namespace slant

#include "reconstruct/cpu_reconstructor.h"

#include "reconstruct/cpu_methods.h"
#include "reconstruct/lens_tiles.h"
#include "reconstruct/stage_timer.h"

#include <array>

namespace slant {
namespace {

/// In the order of Method.
constexpr std::array<CpuMethod*, kMethodCount> kMethods = {boxMethod, windowMethod, fullMethod, fullMethod};

} // namespace

Bins CpuRun::bin() const {
    const Bins bins = [&] {
        StageTimer timer(report, "bin", "samples");
        timer.items = field.samples.size();
        return binSamples(field, searchRegionOf(field, film.filter()));
    }();
    observe("bin.bricks", bins.bricks);
    observe("bin.cells", bins.cellStart);
    observe("bin.positions", bins.positions);
    observe("bin.radiances", bins.radiances);
    return bins;
}

Image CpuReconstructor::reconstruct(const LightField& field, const ReconstructOptions& options,
                                    Monitor& monitor, ReconstructReport& report, StageObserver* observer) {
    LightField scenic;
    const bool throughLens = usesOutputs(options.method) && !field.lensMap.empty();
    if (throughLens) scenic = onSceneSide(field);
    CpuRun run{throughLens ? scenic : field,
               options,
               monitor,
               report,
               observer,
               FilmBuffer(field.frame, makeFilterTable(options.filter))};
    kMethods.at(std::size_t(options.method))(run);
    run.observe("film", run.film.sums());
    return run.film.toImage(report.emptyPixels);
}

} // namespace slant

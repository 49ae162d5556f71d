// Method `box` on the CPU: the input samples through the pixel filter.
#include "reconstruct/cpu_methods.h"
#include "reconstruct/plan.h"
#include "reconstruct/stage_timer.h"

namespace slant {

void boxMethod(CpuRun& run) {
    const LightField& field = run.field;
    StageTimer timer(run.report, "pixel_filter", "samples");
    timer.items = field.samples.size();
    const int planes = int(sampleCounts(field).most);
    for (const Band& band : planBands(field.frame, run.film.filter(), planes, maxDenseSamples(run.options))) {
        const DenseSamples dense = denseFromInput(field, band.region);
        run.observe("dense", dense.samples);
        run.film.accumulate(dense, band.y0, band.y1);
    }
}

} // namespace slant

// Method `box` on the device: the input samples through the pixel filter.
#include "compute/compute_methods.h"
#include "reconstruct/stage_timer.h"

namespace slant {

void boxMethod(ComputeRun& run) {
    const LightField& field = run.field;
    StageTimer timer(run.report, "pixel_filter", "samples");
    timer.items = field.samples.size();
    const int planes = int(sampleCounts(field).most);
    for (const Band& band : planBands(field.frame, run.film.filter(), planes, run.maxSamples)) {
        const DenseSamples samples = denseFromInput(field, band.region);
        Buffer dense(run.device, TexelFormat::rgba32f, samples.samples.size());
        dense.upload(std::span<const vec4>(samples.samples));
        run.observe("dense", dense);
        run.filmPass.accumulate(run.commands, dense, band, planes, 1);
    }
    timer.bytes = run.device.peakBytes();
}

} // namespace slant

// Method `window` on the CPU: every output from a fixed window of pixels.
#include "reconstruct/cpu_methods.h"
#include "reconstruct/stage_timer.h"
#include "reconstruct/window_chunk.h"

#include <algorithm>

namespace slant {

void windowMethod(CpuRun& run) {
    const WindowSamples samples = windowSamples(run.field);
    run.observe("window.positions", samples.positions);
    run.observe("window.radiances", samples.radiances);
    const WindowSearch search = windowSearch(run.field, run.options.window);
    const OutputPattern pattern = makeOutputPattern(run.options.outputsPerPixel, 0, run.options.lensScale,
                                                    apertureOf(run.field, run.options));
    const Plan plan = planOutputs(run.field.frame, run.film.filter(), pattern, maxDenseSamples(run.options));

    run.monitor.beginStage("reconstruct", plan.outputs, "outputs");
    for (const Band& band : plan.bands)
        for (std::size_t group = 0; group < pattern.groups.size(); group += plan.groupsPerChunk) {
            const std::size_t count =
                std::min<std::size_t>(plan.groupsPerChunk, pattern.groups.size() - group);
            WindowChunk chunk(samples, search, run.field.lensMap, pattern, band, run.options.seed, group,
                              count);
            {
                StageTimer timer(run.report, "reconstruct", "outputs");
                chunk.run(run.monitor, run.report);
                timer.items = chunk.dense.samples.size();
                timer.bytes = chunk.dense.samples.size() * sizeof(vec4);
            }
            run.observe("dense", chunk.dense.samples);
            StageTimer timer(run.report, "pixel_filter", "outputs");
            timer.items = chunk.dense.samples.size();
            run.film.accumulate(chunk.dense, band.y0, band.y1);
        }
    run.monitor.endStage();
    warnOfHoles(run.report, run.monitor);
}

} // namespace slant

// Method `full` on the CPU: every output from the bins, with apparent surfaces told apart.
#include "reconstruct/cpu_chunk.h"
#include "reconstruct/cpu_methods.h"
#include "reconstruct/stage_timer.h"

#include <algorithm>

namespace slant {

void fullMethod(CpuRun& run) {
    const Bins bins = run.bin();
    const OutputPattern pattern =
        makeOutputPattern(run.options.outputsPerPixel, largestSlope(bins.grid), run.options.lensScale);
    const Plan plan = planOutputs(run.field.frame, run.film.filter(), pattern, maxDenseSamples(run.options));

    run.monitor.beginStage("reconstruct", plan.outputs, "outputs");
    for (const Band& band : plan.bands)
        for (std::size_t group = 0; group < pattern.groups.size(); group += plan.groupsPerChunk) {
            const std::size_t count =
                std::min<std::size_t>(plan.groupsPerChunk, pattern.groups.size() - group);
            CpuChunk chunk(bins, pattern, band, run.options.seed, group, count);
            {
                StageTimer timer(run.report, "reconstruct", "outputs");
                chunk.run(run.monitor, run.report);
                timer.items = chunk.dense.samples.size();
                timer.bytes = chunk.dense.samples.size() * sizeof(vec4);
            }
            run.observe("lists.start", chunk.lists.start);
            run.observe("lists.bricks", chunk.lists.bricks);
            run.observe("dense", chunk.dense.samples);
            StageTimer timer(run.report, "pixel_filter", "outputs");
            timer.items = chunk.dense.samples.size();
            run.film.accumulate(chunk.dense, band.y0, band.y1, kFilmBlock);
        }
    run.monitor.endStage();
}

} // namespace slant

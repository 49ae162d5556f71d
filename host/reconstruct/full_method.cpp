// Methods `full` and `auto` on the CPU: outputs from the bins, with apparent surfaces told apart; of `auto`,
// only those that the layer map cannot serve.
#include "reconstruct/cpu_chunk.h"
#include "reconstruct/cpu_methods.h"
#include "reconstruct/stage_timer.h"

#include <algorithm>
#include <optional>

namespace slant {

namespace {

/// Stage "layer_map" of `auto`.
LayerMap layerMapOf(CpuRun& run, const Bins& bins, const MapLayout& layout) {
    StageTimer timer(run.report, "layer_map", "texels");
    LayerMap map = makeLayerMap(bins, layout);
    timer.items = map.texels.size();
    timer.bytes = map.texels.size() * sizeof(glm::uvec4);
    run.observe("layer_map", map.texels);
    return map;
}

} // namespace

void fullMethod(CpuRun& run) {
    const Bins& bins = run.bins();
    const ReconstructOptions& options = run.options;
    const Rect& frame = run.field.frame;
    const OutputPattern pattern = makeOutputPattern(options.outputsPerPixel, largestSlope(bins.grid),
                                                    options.lensScale, apertureOf(run.field, options));
    const bool usesMap = usesLayers(run.field, options.method);
    const int texels = mapTexelsPerPixel(run.field);
    const float reach = mapReach(bins.grid, options.lensScale);
    const int maxRows =
        usesMap ? mapRows(frame, texels, reach, options.memoryBytes / 2) : std::numeric_limits<int>::max();
    const Plan plan = planOutputs(frame, run.film.filter(), pattern, maxDenseSamples(options), maxRows);

    run.monitor.beginStage("reconstruct", plan.outputs, "outputs");
    for (const Band& band : plan.bands) {
        std::optional<LayerMap> map;
        if (usesMap)
            map =
                layerMapOf(run, bins, chooseMap(bins.grid, band.region, texels, reach, spreadPerPx(pattern)));
        for (std::size_t group = 0; group < pattern.groups.size(); group += plan.groupsPerChunk) {
            const std::size_t count =
                std::min<std::size_t>(plan.groupsPerChunk, pattern.groups.size() - group);
            CpuChunk chunk(bins, map ? &*map : nullptr, run.field.lensMap, pattern, band, run.options.seed,
                           group, count);
            {
                StageTimer timer(run.report, "reconstruct", "outputs");
                chunk.run(run.monitor, run.report);
                timer.items = chunk.dense.samples.size();
                timer.bytes = chunk.dense.samples.size() * sizeof(vec4);
            }
            if (!run.field.lensMap.empty()) run.observe("lists.lens", chunk.lensBounds);
            run.observe("lists.start", chunk.lists.start);
            run.observe("lists.bricks", chunk.lists.bricks);
            if (map) {
                run.observe("list_classes", chunk.classes.codes);
                run.observe("missed", chunk.classes.missed);
                addMapShare(run.report.mapShare, frame, band, chunk.classes, pattern.groups.size());
            }
            run.observe("dense", chunk.dense.samples);
            StageTimer timer(run.report, "pixel_filter", "outputs");
            timer.items = chunk.dense.samples.size();
            run.film.accumulate(chunk.dense, band.y0, band.y1);
        }
    }
    run.monitor.endStage();
}

} // namespace slant

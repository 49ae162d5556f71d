#include "reconstruct/cpu_reconstructor.h"

#include "reconstruct/cpu_chunk.h"
#include "reconstruct/stage_timer.h"

#include <algorithm>
#include <limits>

namespace slant {
namespace {

template <typename T>
void observe(StageObserver* observer, const char* name, const std::vector<T>& values) {
    if (observer)
        observer->stage(
            name, {reinterpret_cast<const uint*>(values.data()), values.size() * sizeof(T) / sizeof(uint)});
}

Bins timedBins(const LightField& field, const Rect& region, ReconstructReport& report) {
    StageTimer timer(report, "bin", "samples");
    timer.items = field.samples.size();
    return binSamples(field, region, kSearchRadii * emptyCircleRadius(field.samplesPerPixel));
}

void filterBox(const LightField& field, const ReconstructOptions& options, FilmBuffer& film,
               ReconstructReport& report, StageObserver* observer) {
    StageTimer timer(report, "pixel_filter", "samples");
    timer.items = field.samples.size();
    for (const Band& band :
         planBands(field.frame, film.filter(), field.samplesPerPixel, maxDenseSamples(options))) {
        const DenseSamples dense = denseFromInput(field, band.region);
        observe(observer, "dense", dense.samples);
        film.accumulate(dense, band.y0, band.y1, kFilmBlock);
    }
}

void filterFull(const LightField& field, const ReconstructOptions& options, FilmBuffer& film,
                Monitor& monitor, ReconstructReport& report, StageObserver* observer) {
    const Bins bins = timedBins(field, outputRegion(field.frame, film.filter()), report);
    const OutputPattern pattern = makeOutputPattern(options.outputsPerPixel, largestSlope(bins.grid));
    const Plan plan = planOutputs(field.frame, film.filter(), pattern, maxDenseSamples(options));
    observe(observer, "bin.bricks", bins.bricks);
    observe(observer, "bin.cells", bins.cellStart);
    observe(observer, "bin.positions", bins.positions);
    observe(observer, "bin.radiances", bins.radiances);

    monitor.beginStage("reconstruct", plan.outputs, "outputs");
    for (const Band& band : plan.bands)
        for (std::size_t group = 0; group < pattern.groups.size(); group += plan.groupsPerChunk) {
            const std::size_t count =
                std::min<std::size_t>(plan.groupsPerChunk, pattern.groups.size() - group);
            CpuChunk chunk(bins, pattern, band, options.seed, group, count);
            {
                StageTimer timer(report, "reconstruct", "outputs");
                chunk.run(monitor, report);
                timer.items = chunk.dense.samples.size();
                timer.bytes = chunk.dense.samples.size() * sizeof(vec4);
            }
            observe(observer, "lists.start", chunk.lists.start);
            observe(observer, "lists.bricks", chunk.lists.bricks);
            observe(observer, "dense", chunk.dense.samples);
            StageTimer timer(report, "pixel_filter", "outputs");
            timer.items = chunk.dense.samples.size();
            film.accumulate(chunk.dense, band.y0, band.y1, kFilmBlock);
        }
    monitor.endStage();
}

} // namespace

Image CpuReconstructor::reconstruct(const LightField& field, const ReconstructOptions& options,
                                    Monitor& monitor, ReconstructReport& report, StageObserver* observer) {
    FilmBuffer film(field.frame, makeFilterTable(options.filter));
    if (options.method == Method::box)
        filterBox(field, options, film, report, observer);
    else
        filterFull(field, options, film, monitor, report, observer);
    observe(observer, "film", film.sums());
    return film.toImage(report.emptyPixels);
}

} // namespace slant

// slant reference: brute force, the ground truth.
#include "base/parallel.h"
#include "commands/commands.h"
#include "commands/picture_job.h"
#include "reconstruct/film_buffer.h"
#include "reconstruct/plan.h"
#include "trace/tracer.h"

#include <memory>

namespace slant::commands {
namespace {

/// Samples of a pixel traced at a time, a multiple of the film's block.
constexpr int kBatch = 4 * kFilmBlock;

/// The same pattern and pixel filter as `render --method box`, at any number of samples in bounded memory.
Image bruteForce(const Scene& scene, const Tracer& tracer, std::uint64_t seed, Monitor& monitor) {
    FilmBuffer film(scene.film.crop, makeFilterTable(scene.filter));
    LightField batch;
    batch.frame = scene.film.crop;
    batch.bounds = outputRegion(scene.film.crop, film.filter());
    FieldDefects defects;
    monitor.beginStage("trace", batch.bounds.area() * std::uint64_t(scene.pixelSamples), "samples");
    for (int first = 0; first < scene.pixelSamples; first += kBatch) {
        batch.samplesPerPixel = std::min(kBatch, scene.pixelSamples - first);
        batch.samples.resize(batch.bounds.area() * std::size_t(batch.samplesPerPixel));
        tracer.trace(batch.bounds, first, batch.samplesPerPixel, scene.pixelSamples, seed, batch.samples, {},
                     monitor);
        defects.add(sanitize(batch));
        film.accumulate(denseFromInput(batch, batch.bounds), film.frame().y0, film.frame().y1, kFilmBlock);
    }
    monitor.endStage();
    std::uint64_t emptyPixels = 0;
    Image image = film.toImage(emptyPixels);
    warnOf(defects, emptyPixels, monitor);
    image.displayWindow = {0, 0, scene.film.xResolution, scene.film.yResolution};
    return image;
}

void runReference(PictureOptions options) {
    const Stopwatch watch;
    const ThreadLimit threads(options.common.threads);
    TerminalMonitor monitor(TerminalMonitor::styleOfStderr(options.common.quiet));
    const Scene scene = readSceneFor(options, monitor);
    if (options.output.empty()) options.output = scene.film.filename;
    checkOutputs(options);
    const Tracer tracer(scene, monitor);
    const Image image = bruteForce(scene, tracer, options.common.seed, monitor);
    const nlohmann::ordered_json details = {{"scene", options.scene},
                                            {"method", "reference"},
                                            {"spp", scene.pixelSamples},
                                            {"seed", options.common.seed}};
    writeOutputs(options, image, details, monitor.stages(), watch.seconds());
}

} // namespace

void addReference(CLI::App& program) {
    CLI::App* command = program.add_subcommand("reference", "Render by brute force: the ground truth");
    const auto options = std::make_shared<PictureOptions>();
    addPictureOptions(*command, *options);
    command->callback([options] { runReference(*options); });
}

} // namespace slant::commands

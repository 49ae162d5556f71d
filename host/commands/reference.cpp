// slant reference: brute force, the ground truth.
#include "base/parallel.h"
#include "commands/commands.h"
#include "commands/picture_job.h"
#include "render/brute_force.h"
#include "trace/tracer.h"

#include <memory>

namespace slant::commands {
namespace {

void runReference(PictureOptions options) {
    const Stopwatch watch;
    const ThreadLimit threads(options.common.threads);
    TerminalMonitor monitor(TerminalMonitor::styleOfStderr(options.common.quiet));
    const Scene scene = readSceneFor(options.input, options.reading, options.common, monitor);
    if (options.output.empty()) options.output = scene.film.filename;
    checkOutputs(options);
    // Slopes don't count here, and depths for auxiliary channels alone.
    const Tracer tracer(scene, monitor, options.auxiliary ? SlopeSource::optics : SlopeSource::surface);
    BruteForce result = bruteForce(scene, tracer, options.common.seed, monitor, options.auxiliary);
    warnOf(result.defects, result.emptyPixels, monitor);
    result.image.displayWindow = {0, 0, scene.film.xResolution, scene.film.yResolution};
    const nlohmann::ordered_json details = {{"scene", options.input},
                                            {"method", "reference"},
                                            {"spp", scene.pixelSamples},
                                            {"seed", options.common.seed}};
    writeOutputs(options, result.image, details, monitor.stages(), watch.seconds());
}

} // namespace

void addReference(CLI::App& program) {
    CLI::App* command = program.add_subcommand("reference", "Render by brute force: the ground truth");
    const auto options = std::make_shared<PictureOptions>();
    addPictureOptions(*command, *options);
    command->callback([options] { runReference(*options); });
}

} // namespace slant::commands

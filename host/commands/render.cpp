// slant render: the main job: trace a light field, reconstruct it, filter it.
#include "render/render.h"
#include "base/parallel.h"
#include "commands/commands.h"
#include "commands/picture_job.h"
#include "commands/reconstruction.h"
#include "commands/stats_file.h"

#include <memory>
#include <optional>

namespace slant::commands {
namespace {

struct RenderCommand {
    PictureOptions picture;
    double placedShare = 0;
    std::optional<double> targetRelMse;
    bool compareWithCpu = false;
};

void runRender(RenderCommand options) {
    const Stopwatch watch;
    const CommonOptions& common = options.picture.common;
    checkMethodOptions(common);
    const ThreadLimit threads(common.threads);
    TerminalMonitor monitor(TerminalMonitor::styleOfStderr(common.quiet));
    Backend backend(common.device, common.threads);
    const Scene scene = readSceneFor(options.picture.input, options.picture.reading, common, monitor);
    if (options.picture.output.empty()) options.picture.output = scene.film.filename;
    checkOutputs(options.picture);

    RenderOptions rendering;
    rendering.sampling.samplesPerPixel = scene.pixelSamples;
    rendering.sampling.seed = common.seed;
    rendering.sampling.slopes = common.slopes;
    rendering.placedShare = options.placedShare;
    rendering.targetRelMse = options.targetRelMse;
    rendering.reconstruction = reconstructOptions(common, scene.filter, backend);
    rendering.auxiliary = options.picture.auxiliary;
    rendering.errorChannels = options.picture.errorChannels;
    rendering.compareWithCpu = options.compareWithCpu;
    const Rendering result = render(scene, rendering, backend, monitor);
    printAgreements(result.agreements, backend);
    warnOf(result.traced.defects, result.report.emptyPixels, monitor);
    nlohmann::ordered_json details = {{"scene", options.picture.input}};
    addDetails(details, common, result.traced.field, backend, result.report);
    if (result.estimatedRelMse) details["estimatedRelMse"] = *result.estimatedRelMse;
    if (result.traced.field.moves()) addMisses(details, result.traced.misses);
    writeDebugImage(options.picture, result.traced.field.frame, result.report);
    writeOutputs(options.picture, result.image, details, stagesOf(monitor.stages(), result.report),
                 watch.seconds());
}

} // namespace

void addRender(CLI::App& program) {
    CLI::App* command =
        program.add_subcommand("render", "Trace a few samples per pixel and reconstruct the picture");
    const auto options = std::make_shared<RenderCommand>();
    addPictureOptions(*command, options->picture);
    addSlopesOption(*command, options->picture.common);
    addReconstructionOptions(*command, options->picture.common);
    addErrorChannelsOption(*command, options->picture);
    addNumber<double>(
        *command, "--adaptive", options->placedShare, 0, 0.95,
        "share of the samples that are traced after the others, where the estimated error of the "
        "picture is largest (default 0)");
    addNumber<double>(
        *command, "--error", options->targetRelMse, 1e-9, 1e9,
        "go on tracing samples, where the estimated error is largest, until the estimated relMSE of "
        "the picture is as low as this");
    addCompareOption(*command, options->compareWithCpu);
    command->callback([options] { runRender(*options); });
}

} // namespace slant::commands

// slant render: the main job: trace a light field, reconstruct it, filter it.
#include "base/parallel.h"
#include "commands/commands.h"
#include "commands/picture_job.h"
#include "commands/reconstruction.h"
#include "reconstruct/plan.h"
#include "trace/sample_pass.h"

#include <memory>

namespace slant::commands {
namespace {

struct RenderOptions {
    PictureOptions picture;
    bool compareWithCpu = false;
};

void runRender(RenderOptions options) {
    const Stopwatch watch;
    const CommonOptions& common = options.picture.common;
    checkMethodOptions(common);
    const ThreadLimit threads(common.threads);
    TerminalMonitor monitor(TerminalMonitor::styleOfStderr(common.quiet));
    Backend backend(common.device, common.threads);
    const Scene scene = readSceneFor(options.picture.input, common, monitor);
    if (options.picture.output.empty()) options.picture.output = scene.film.filename;
    checkOutputs(options.picture);
    const ReconstructOptions reconstruction = reconstructOptions(common, scene.filter, backend);
    checkBudget(scene.film.crop, scene.pixelSamples, reconstruction);

    const Tracer tracer(scene, monitor);
    SampleOptions sampling;
    sampling.samplesPerPixel = scene.pixelSamples;
    sampling.seed = common.seed;
    sampling.auxiliary = options.picture.auxiliary;
    LightField field = traceLightField(tracer, scene, sampling, monitor);
    const FieldDefects defects = sanitize(field);

    ReconstructReport report;
    FieldPictures pictures(backend, field, reconstruction, options.compareWithCpu);
    Image image = pictures.colours(0, monitor, report);
    if (options.picture.auxiliary) pictures.addAuxiliary(image, 0, monitor, report);
    image.displayWindow = {0, 0, scene.film.xResolution, scene.film.yResolution};
    warnOf(defects, report.emptyPixels, monitor);
    nlohmann::ordered_json details = {{"scene", options.picture.input}};
    addDetails(details, common, field, backend, report);
    writeDebugImage(options.picture, field.frame, report);
    writeOutputs(options.picture, image, details, stagesOf(monitor.stages(), report), watch.seconds());
}

} // namespace

void addRender(CLI::App& program) {
    CLI::App* command =
        program.add_subcommand("render", "Trace a few samples a pixel and reconstruct the picture");
    const auto options = std::make_shared<RenderOptions>();
    addPictureOptions(*command, options->picture);
    addReconstructionOptions(*command, options->picture.common);
    addCompareOption(*command, options->compareWithCpu);
    command->callback([options] { runRender(*options); });
}

} // namespace slant::commands

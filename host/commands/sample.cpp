// slant sample: traces a light field into a file.
#include "base/atomic_file.h"
#include "base/parallel.h"
#include "commands/commands.h"
#include "commands/picture_job.h"
#include "commands/stats_file.h"
#include "lightfield/field_file.h"
#include "render/render.h"
#include "trace/sample_pass.h"

#include <memory>

namespace slant::commands {
namespace {

struct FieldOptions {
    CommonOptions common;
    ReadOptions reading;
    std::string scene, output;
    bool auxiliary = false, shading = false;
};

void checkOptions(const FieldOptions& options) {
    if (formatForName(options.output) != FieldFormat::deepExr && (options.auxiliary || options.shading))
        throw Error(
            ErrorCode::usage,
            fmt::format("'{}': TLFR has no room for what --auxiliary and --shading record; write a .exr",
                        options.output));
    for (const std::string& path : {options.output, options.common.statsPath})
        if (!path.empty()) checkWritable(path);
}

void runSample(const FieldOptions& options) {
    const Stopwatch watch;
    const CommonOptions& common = options.common;
    const ThreadLimit threads(common.threads);
    TerminalMonitor monitor(TerminalMonitor::styleOfStderr(common.quiet));
    checkOptions(options);
    const Scene scene = readSceneFor(options.scene, options.reading, common, monitor);
    const Tracer tracer(scene, monitor, common.slopes);
    SampleOptions sampling;
    sampling.samplesPerPixel = scene.pixelSamples;
    sampling.seed = common.seed;
    sampling.planes = {.albedo = options.auxiliary,
                       .shading = options.shading,
                       .shadows = options.shading && hasSoftShadows(scene)};
    MotionMisses misses;
    const LightField field = traceLightField(tracer, scene, sampling, monitor, &misses);

    writeField(options.output, field, metadataOf(scene, tracer.camera(), options.scene, common.seed),
               monitor);
    if (common.statsPath.empty()) return;
    nlohmann::ordered_json details = {{"scene", options.scene},
                                      {"spp", field.samplesPerPixel},
                                      {"seed", common.seed},
                                      {"samples", field.samples.size()}};
    if (field.moves()) addMisses(details, misses);
    writeStats(common.statsPath, monitor.stages(), watch.seconds(), details);
}

} // namespace

void addSample(CLI::App& program) {
    CLI::App* command = program.add_subcommand("sample", "Trace a light field into a file");
    const auto options = std::make_shared<FieldOptions>();
    addSceneOptions(*command, options->scene, options->reading);
    command
        ->add_option("-o,--output", options->output,
                     "light field to write: deep OpenEXR (.exr) or TLFR "
                     "(.bin, .txt, with a .header beside it)")
        ->required()
        ->type_name("FILE");
    command->add_flag("--auxiliary", options->auxiliary, "store albedo and normal of every sample");
    command->add_flag("--shading", options->shading,
                      "record the parts of the radiance that noise is filtered by");
    addSamplingOptions(*command, options->common);
    addSlopesOption(*command, options->common);
    addRunOptions(*command, options->common);
    command->callback([options] { runSample(*options); });
}

} // namespace slant::commands

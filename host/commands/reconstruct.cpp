// slant reconstruct: a picture from a light field in a file.
#include "base/parallel.h"
#include "commands/commands.h"
#include "commands/picture_job.h"
#include "commands/reconstruction.h"
#include "lightfield/field_file.h"
#include "reconstruct/plan.h"

#include <memory>

namespace slant::commands {
namespace {

struct FromFileOptions {
    PictureOptions picture;
    std::optional<std::uint64_t> seed; ///< unset: the field's
    bool compareWithCpu = false;
};

FieldFile readFieldFor(const std::string& path, Monitor& monitor) {
    FieldFile file = readField(path, monitor);
    if (file.movingSamples > 0)
        throw badInput({path}, "{} of its {} samples move, and motion is not reconstructed",
                       file.movingSamples, file.field.samples.size());
    return file;
}

void runReconstruct(FromFileOptions options) {
    const Stopwatch watch;
    CommonOptions& common = options.picture.common;
    checkMethodOptions(common);
    const ThreadLimit threads(common.threads);
    TerminalMonitor monitor(TerminalMonitor::styleOfStderr(common.quiet));
    checkOutputs(options.picture);
    Backend backend(common.device, common.threads);
    FieldFile file = readFieldFor(options.picture.input, monitor);
    LightField& field = file.field;
    common.seed = options.seed.value_or(file.details.seed);
    const ReconstructOptions reconstruction =
        reconstructOptions(common, file.details.filter.value_or(PixelFilter()), backend);
    checkBudget(field.frame, field.samplesPerPixel, reconstruction);
    const FieldDefects defects = sanitize(field);

    ReconstructReport report;
    Image image = reconstruct(backend, field, reconstruction, options.compareWithCpu, monitor, report);
    image.displayWindow = file.details.film;
    warnOf(defects, report.emptyPixels, monitor);
    nlohmann::ordered_json details = {{"field", options.picture.input}, {"scene", file.details.source}};
    addDetails(details, common, field, backend, report);
    writeOutputs(options.picture, image, details, stagesOf(monitor.stages(), report), watch.seconds());
}

} // namespace

void addReconstruct(CLI::App& program) {
    CLI::App* command =
        program.add_subcommand("reconstruct", "Reconstruct the picture of a light field's file");
    const auto options = std::make_shared<FromFileOptions>();
    command->add_option("FIELD", options->picture.input, "light field: deep OpenEXR or TLFR")
        ->required()
        ->type_name("");
    command->add_option("-o,--output", options->picture.output, "picture to write")
        ->required()
        ->type_name("FILE.exr");
    addImageOptions(*command, options->picture);
    addReconstructionOptions(*command, options->picture.common);
    addNumber<std::uint64_t>(*command, "--seed", options->seed, 0, std::numeric_limits<std::uint64_t>::max(),
                             "of the output pattern (default: the field's)");
    addCompareOption(*command, options->compareWithCpu);
    addRunOptions(*command, options->picture.common);
    command->callback([options] { runReconstruct(*options); });
}

} // namespace slant::commands

// slant render: the main job: trace a light field, reconstruct it, filter it.
#include "base/parallel.h"
#include "commands/commands.h"
#include "commands/picture_job.h"
#include "compute/backend.h"
#include "reconstruct/cpu_reconstructor.h"
#include "reconstruct/plan.h"
#include "reconstruct/stage_compare.h"
#include "reconstruct/window.h"
#include "trace/sample_pass.h"

#include <bit>
#include <memory>

namespace slant::commands {
namespace {

struct RenderOptions {
    PictureOptions picture;
    bool compareWithCpu = false;
};

ReconstructOptions reconstructOptions(const CommonOptions& common, const Scene& scene,
                                      const Backend& backend) {
    ReconstructOptions options;
    options.method = common.method;
    options.window = common.window;
    options.outputsPerPixel = common.outSpp;
    options.filter = scene.filter;
    options.seed = common.seed;
    options.memoryBytes = common.memoryBytes;
    // So that the CPU cuts a picture into the chunks that the device can hold.
    if (backend.device)
        options.memoryBytes =
            std::min(options.memoryBytes, 2 * sizeof(vec4) * backend.device->limits().texelBufferElements);
    return options;
}

std::string describe(const StageDifference& d, const std::vector<uint>& expected) {
    if (d.got.empty())
        return fmt::format("stage {} '{}' has {} words on the CPU and {} on the device", d.stage, d.name,
                           d.expectedWords, d.gotWords);
    std::size_t i = 0;
    while (i + 1 < d.got.size() && i < expected.size() && expected[i] == d.got[i]) ++i;
    return fmt::format(
        "stage {} '{}' differs first at word {} of {}: cpu {:#010x} ({:.9g}), device {:#010x} ({:.9g})",
        d.stage, d.name, d.firstWord + i, d.gotWords, expected.at(i), std::bit_cast<float>(expected[i]),
        d.got[i], std::bit_cast<float>(d.got[i]));
}

/// Runs the CPU beside the backend; Error(outOfBounds) at the first stage that differs.
Image reconstructAndCompare(Backend& backend, const LightField& field, const ReconstructOptions& options,
                            Monitor& monitor, ReconstructReport& report) {
    CpuReconstructor cpu;
    ReconstructReport cpuReport;
    StageRecorder expected;
    cpu.reconstruct(field, options, monitor, cpuReport, &expected);
    StageComparer comparer(expected);
    Image image = backend.reconstructor->reconstruct(field, options, monitor, report, &comparer);
    if (const auto difference = comparer.difference()) {
        StageReader reader(difference->stage, difference->firstWord, difference->got.size());
        if (!difference->got.empty()) cpu.reconstruct(field, options, monitor, cpuReport, &reader);
        throw Error(ErrorCode::outOfBounds, describe(*difference, reader.words()));
    }
    fmt::print(
        "{} stages, {} words: {} and cpu agree to the bit\n", expected.stages().size(),
        [&] {
            std::size_t words = 0;
            for (const auto& stage : expected.stages()) words += stage.words;
            return words;
        }(),
        backend.name);
    return image;
}

nlohmann::ordered_json detailsOf(const RenderOptions& options, const Scene& scene, const LightField& field,
                                 const Backend& backend, const ReconstructReport& report) {
    const CommonOptions& common = options.picture.common;
    nlohmann::ordered_json details = {{"scene", options.picture.scene},
                                      {"method", nameOf(common.method)},
                                      {"device", backend.name},
                                      {"spp", scene.pixelSamples},
                                      {"seed", common.seed},
                                      {"c1", field.slopeModel.c1},
                                      {"c2", field.slopeModel.c2},
                                      {"samples", field.samples.size()},
                                      {"overscanLeft", field.frame.x0 - field.bounds.x0},
                                      {"overscanTop", field.frame.y0 - field.bounds.y0},
                                      {"overscanRight", field.bounds.x1 - field.frame.x1},
                                      {"overscanBottom", field.bounds.y1 - field.frame.y1}};
    if (common.method != Method::box) {
        details["outSpp"] = common.outSpp;
        details["outputs"] = report.outputs;
        details["visibility"] = report.visibility;
        details["widened"] = report.widened;
        details["holes"] = report.holes;
        details["overflowed"] = report.overflowed;
    }
    if (common.method == Method::window) {
        const WindowSearch search = windowSearch(field, common.window);
        details["windowRange"] = search.rangePx;
        details["windowAlpha"] = search.alpha;
        details["windowDelta"] = search.lensStep;
        details["windowFill"] = search.fill != 0;
    }
    return details;
}

void runRender(RenderOptions options) {
    const Stopwatch watch;
    const CommonOptions& common = options.picture.common;
    checkMethodOptions(common);
    const ThreadLimit threads(common.threads);
    TerminalMonitor monitor(TerminalMonitor::styleOfStderr(common.quiet));
    Backend backend(common.device, common.threads);
    const Scene scene = readSceneFor(options.picture, monitor);
    if (options.picture.output.empty()) options.picture.output = scene.film.filename;
    checkOutputs(options.picture);
    const ReconstructOptions reconstruction = reconstructOptions(common, scene, backend);
    checkBudget(scene.film.crop, scene.pixelSamples, reconstruction);

    const Tracer tracer(scene, monitor);
    SampleOptions sampling;
    sampling.samplesPerPixel = scene.pixelSamples;
    sampling.seed = common.seed;
    LightField field = traceLightField(tracer, scene, sampling, monitor);
    const FieldDefects defects = sanitize(field);

    ReconstructReport report;
    Image image = options.compareWithCpu
                      ? reconstructAndCompare(backend, field, reconstruction, monitor, report)
                      : backend.reconstructor->reconstruct(field, reconstruction, monitor, report, nullptr);
    image.displayWindow = {0, 0, scene.film.xResolution, scene.film.yResolution};
    warnOf(defects, report.emptyPixels, monitor);

    std::vector<StageStats> stages = monitor.stages();
    std::erase_if(stages, [](const StageStats& stage) { return stage.name == "reconstruct"; });
    stages.insert(stages.end(), report.stages.begin(), report.stages.end());
    writeOutputs(options.picture, image, detailsOf(options, scene, field, backend, report), stages,
                 watch.seconds());
}

} // namespace

void addRender(CLI::App& program) {
    CLI::App* command =
        program.add_subcommand("render", "Trace a few samples a pixel and reconstruct the picture");
    const auto options = std::make_shared<RenderOptions>();
    addPictureOptions(*command, options->picture);
    addReconstructionOptions(*command, options->picture.common);
    const auto compare = [options](const std::string& with) {
        if (with != "cpu") throw CLI::ValidationError("--compare", fmt::format("'{}' is not cpu", with));
        options->compareWithCpu = true;
    };
    command
        ->add_option_function<std::string>("--compare", compare,
                                           "also run on the CPU, and stop at the first stage that differs")
        ->type_name("cpu");
    command->callback([options] { runRender(*options); });
}

} // namespace slant::commands

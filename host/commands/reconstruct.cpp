// slant reconstruct: pictures from a light field file, through the traced lens or another, at any time.
#include "base/parallel.h"
#include "commands/commands.h"
#include "commands/picture_job.h"
#include "commands/reconstruction.h"
#include "commands/stats_file.h"
#include "commands/view_options.h"
#include "lightfield/field_file.h"
#include "lightfield/refocus.h"
#include "reconstruct/plan.h"
#include "render/auxiliary.h"
#include "render/error_estimate.h"
#include "report/work_monitor.h"

#include <memory>

namespace slant::commands {
namespace {

struct FromFileOptions {
    PictureOptions picture;
    ViewOptions view;
    std::optional<std::uint64_t> seed; ///< unset: the field's
    bool compareWithCpu = false;
};

/// Share of a lens that is too small for a warning.
constexpr double kNegligible = 0.005;

/// One run: a field and the pictures made from it.
class Job {
public:
    Job(const FromFileOptions& options, TerminalMonitor& monitor)
        : options_(options), backend_(options.picture.common.device, options.picture.common.threads),
          file_(readField(options.picture.input, monitor)), traced_(file_.field.slopeModel) {
        for (const ViewStep& step : viewSteps(options.view))
            steps_.push_back(
                {step, step.focusDistance ? focusedAt(file_.field, *step.focusDistance) : traced_});
        defects_ = sanitize(file_.field);
        CommonOptions& common = options_.picture.common;
        common.seed = options_.seed.value_or(file_.details.seed);
        reconstruction_ = reconstructOptions(common, file_.details.filter.value_or(PixelFilter()), backend_);
        view_.apertureScale = apertureScale(options_.view, file_.details);
        if (!options_.view.aperture.empty())
            view_.aperture = Aperture(readAperture(options_.view.aperture, "", {}));
        if (!file_.field.lensMap.empty() && !view_.isTracedLens())
            throw Error(ErrorCode::usage, "the field is not that of a thin lens: what another aperture would "
                                          "make of its pupils is not known");
        reconstruction_.anyFocus = options_.view.refocuses();
        checkBudget(file_.field.frame, int(sampleCounts(file_.field).max), reconstruction_);
        if (options_.view.changesTime() && !file_.field.moves())
            monitor.warn("nothing moves in this field: it looks the same at every time");
        const double outside =
            shareOutside(view_.apertureOf(file_.field), view_.apertureScale, file_.field.aperture);
        if (outside > kNegligible)
            monitor.warn(
                fmt::format("{:.2g} % of this lens lies outside the traced one and is extrapolation: "
                            "what only that part would see is missing",
                            100 * outside));
    }

    void run(TerminalMonitor& monitor, const Stopwatch& watch) {
        FieldPictures pictures(backend_, file_.field, reconstruction_, options_.compareWithCpu);
        if (steps_.size() == 1) return single(pictures, monitor, watch);
        const std::size_t passes =
            1 + (options_.picture.auxiliary
                     ? auxiliarySets(file_.field.hasGuides(), file_.field.moves()).size()
                     : 0);
        const std::uint64_t share =
            passes * file_.field.frame.area() * std::uint64_t(reconstruction_.outputsPerPixel);
        monitor.beginStage("frames", steps_.size() * share, "outputs");
        WorkMonitor frames(monitor);
        for (std::size_t i = 0; i < steps_.size(); ++i) {
            frames.beginShare(share, "");
            const Stopwatch frameWatch;
            PictureOptions picture = options_.picture;
            picture.output = numbered(picture.output, i + 1);
            picture.png = numbered(picture.png, i + 1);
            picture.common.statsPath.clear();
            ReconstructReport report;
            const Image image = make(pictures, steps_[i], frames, report);
            writeDebugImage(picture, file_.field.frame, report);
            writeOutputs(picture, image, details(steps_[i], report), report.stages, frameWatch.seconds());
        }
        frames.endShare();
        monitor.endStage();
        if (const std::string& path = options_.picture.common.statsPath; !path.empty())
            writeStats(path, monitor.stages(), watch.seconds(),
                       {{"field", options_.picture.input}, {"frames", steps_.size()}});
    }

private:
    /// Of one picture.
    struct Step : ViewStep {
        SlopeModel model;
    };

    void single(FieldPictures& pictures, TerminalMonitor& monitor, const Stopwatch& watch) {
        ReconstructReport report;
        const Image image = make(pictures, steps_[0], monitor, report);
        writeDebugImage(options_.picture, file_.field.frame, report);
        writeOutputs(options_.picture, image, details(steps_[0], report), stagesOf(monitor.stages(), report),
                     watch.seconds());
    }

    Image make(FieldPictures& pictures, const Step& step, Monitor& monitor, ReconstructReport& report) {
        LensView view = view_;
        view.slopeShift = step.model.c2 - traced_.c2;
        view.shutterOpen = step.shutter.open;
        view.shutterClose = step.shutter.close;
        if (step.focusDistance || view.apertureScale > 1)
            if (const int missing = missingOverscanPx(file_.field, view); missing > 0)
                monitor.warn(
                    fmt::format("blur reaches {} pixels beyond the samples: borders may lack what enters "
                                "from farther out",
                                missing));
        Image image = pictures.colours(view, monitor, report);
        if (options_.picture.auxiliary) pictures.addAuxiliary(image, view, monitor, report);
        std::vector<Agreement> agreements = pictures.takeAgreements();
        if (options_.picture.errorChannels)
            ErrorEstimate(backend_, file_.field, reconstruction_, view, options_.compareWithCpu, monitor,
                          report, agreements)
                .addChannels(image);
        printAgreements(agreements, backend_);
        image.displayWindow = file_.details.film;
        warnOf(defects_, report.emptyPixels, monitor);
        return image;
    }

    nlohmann::ordered_json details(const Step& step, const ReconstructReport& report) const {
        nlohmann::ordered_json json = {{"field", options_.picture.input}, {"scene", file_.details.source}};
        addDetails(json, options_.picture.common, file_.field, backend_, report);
        json["c1"] = step.model.c1;
        json["c2"] = step.model.c2;
        if (step.focusDistance) json["focusDistance"] = *step.focusDistance;
        if (!step.shutter.isTraced()) {
            json["shutterOpen"] = step.shutter.open;
            json["shutterClose"] = step.shutter.close;
        }
        if (view_.apertureScale != 1) json["apertureScale"] = view_.apertureScale;
        if (view_.aperture) json["aperture"] = view_.aperture->shape().name;
        return json;
    }

    FromFileOptions options_;
    Backend backend_;
    FieldFile file_;
    SlopeModel traced_;
    std::vector<Step> steps_; ///< of each picture
    FieldDefects defects_;
    ReconstructOptions reconstruction_;
    LensView view_; ///< of each picture, but for its focus and its shutter
};

void runReconstruct(const FromFileOptions& options) {
    const Stopwatch watch;
    const CommonOptions& common = options.picture.common;
    checkMethodOptions(common);
    checkViewOptions(options.view, common.method);
    const ThreadLimit threads(common.threads);
    TerminalMonitor monitor(TerminalMonitor::styleOfStderr(common.quiet));
    checkOutputs(options.picture);
    Job(options, monitor).run(monitor, watch);
}

} // namespace

void addReconstruct(CLI::App& program) {
    CLI::App* command = program.add_subcommand("reconstruct", "Reconstruct pictures from a light field file");
    const auto options = std::make_shared<FromFileOptions>();
    command->add_option("FIELD", options->picture.input, "light field: deep OpenEXR or TLFR")
        ->required()
        ->type_name("");
    command->add_option("-o,--output", options->picture.output, "picture to write")
        ->required()
        ->type_name("FILE.exr");
    addImageOptions(*command, options->picture);
    addViewOptions(*command, options->view);
    addReconstructionOptions(*command, options->picture.common);
    addErrorChannelsOption(*command, options->picture);
    addNumber<std::uint64_t>(*command, "--seed", options->seed, 0, std::numeric_limits<std::uint64_t>::max(),
                             "seed of the output pattern (default: the field's)");
    addCompareOption(*command, options->compareWithCpu);
    addRunOptions(*command, options->picture.common);
    command->callback([options] { runReconstruct(*options); });
}

} // namespace slant::commands

#include "commands/reconstruction.h"

#include "image/png.h"
#include "reconstruct/auxiliary.h"
#include "reconstruct/cpu_reconstructor.h"
#include "reconstruct/intermediates.h"
#include "reconstruct/window.h"

#include <bit>

namespace slant::commands {
namespace {

std::string describe(const IntermediateDifference& d, const std::vector<uint>& expected) {
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

/// Samples a pixel: on average, where pixels differ.
nlohmann::ordered_json sppOf(const LightField& field) {
    if (field.pixelStart.empty()) return field.samplesPerPixel;
    return float(sampleCounts(field).mean);
}

} // namespace

void addCompareOption(CLI::App& command, bool& compareWithCpu) {
    const auto compare = [&compareWithCpu](const std::string& with) {
        if (with != "cpu") throw CLI::ValidationError("--compare", fmt::format("'{}' is not cpu", with));
        compareWithCpu = true;
    };
    command
        .add_option_function<std::string>("--compare", compare,
                                          "also run on the CPU, and stop at the first stage that differs")
        ->type_name("cpu");
}

ReconstructOptions reconstructOptions(const CommonOptions& common, const PixelFilter& filter,
                                      const Backend& backend) {
    ReconstructOptions options;
    options.method = common.method;
    options.window = common.window;
    options.outputsPerPixel = common.outSpp;
    options.filter = filter;
    options.seed = common.seed;
    options.memoryBytes = common.memoryBytes;
    // So that the CPU cuts a picture into the chunks that the device can hold.
    if (backend.device)
        options.memoryBytes =
            std::min(options.memoryBytes, 2 * sizeof(vec4) * backend.device->limits().texelBufferElements);
    return options;
}

FieldPictures::FieldPictures(Backend& backend, LightField& field, const ReconstructOptions& options,
                             bool compareWithCpu)
    : backend_(backend), field_(field), prepared_(backend.reconstructor->prepare(field, options)) {
    if (compareWithCpu) onCpu_ = CpuReconstructor().prepare(field, options);
}

Image FieldPictures::colours(float slopeShift, Monitor& monitor, ReconstructReport& report) {
    if (!colours_.empty()) {
        putRadiances(field_, colours_);
        colours_.clear();
        takeRadiances();
    }
    return picture(slopeShift, monitor, report);
}

void FieldPictures::addAuxiliary(Image& image, float slopeShift, Monitor& monitor,
                                 ReconstructReport& report) {
    if (field_.auxiliary.empty())
        monitor.warn("the samples have neither albedo nor normals: A and Z alone are written");
    if (colours_.empty()) colours_ = radiancesOf(field_);
    ReconstructReport ofSets;
    const Stopwatch watch;
    for (const AuxiliarySet& set : auxiliarySets(!field_.auxiliary.empty())) {
        takeValues(field_, set);
        takeRadiances();
        addChannels(image, set, picture(slopeShift, monitor, ofSets));
    }
    StageStats& stage = report.stage("auxiliary", "outputs");
    stage.seconds = watch.seconds();
    stage.items = ofSets.outputs;
}

void FieldPictures::takeRadiances() {
    prepared_->takeRadiances();
    if (onCpu_) onCpu_->takeRadiances();
}

Image FieldPictures::picture(float slopeShift, Monitor& monitor, ReconstructReport& report) {
    return onCpu_ ? pictureAndCompare(slopeShift, monitor, report)
                  : prepared_->picture(slopeShift, monitor, report, nullptr);
}

Image FieldPictures::pictureAndCompare(float slopeShift, Monitor& monitor, ReconstructReport& report) {
    ReconstructReport cpuReport;
    IntermediateRecorder expected;
    onCpu_->picture(slopeShift, monitor, cpuReport, &expected);
    IntermediateComparer comparer(expected);
    Image image = prepared_->picture(slopeShift, monitor, report, &comparer);
    if (const auto difference = comparer.difference()) {
        IntermediateReader reader(difference->stage, difference->firstWord, difference->got.size());
        if (!difference->got.empty()) onCpu_->picture(slopeShift, monitor, cpuReport, &reader);
        throw Error(ErrorCode::outOfBounds, describe(*difference, reader.words()));
    }
    std::size_t words = 0;
    for (const auto& stage : expected.stages()) words += stage.words;
    fmt::print("{} stages, {} words: {} and cpu agree to the bit\n", expected.stages().size(), words,
               backend_.name);
    return image;
}

void addDetails(nlohmann::ordered_json& details, const CommonOptions& common, const LightField& field,
                const Backend& backend, const ReconstructReport& report) {
    details.update({{"method", nameOf(common.method)},
                    {"device", backend.name},
                    {"spp", sppOf(field)},
                    {"seed", common.seed},
                    {"c1", field.slopeModel.c1},
                    {"c2", field.slopeModel.c2},
                    {"samples", field.samples.size()},
                    {"overscanLeft", field.frame.x0 - field.bounds.x0},
                    {"overscanTop", field.frame.y0 - field.bounds.y0},
                    {"overscanRight", field.bounds.x1 - field.frame.x1},
                    {"overscanBottom", field.bounds.y1 - field.frame.y1}});
    if (!field.aperture.isDisc()) details["aperture"] = field.aperture.shape().name;
    if (common.method != Method::box) {
        details["outSpp"] = common.outSpp;
        details["outputs"] = report.outputs;
        if (common.method == Method::automatic) details["layered"] = report.fromMap;
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
}

void writeDebugImage(const PictureOptions& options, const Rect& frame, const ReconstructReport& report) {
    if (!options.common.debugLayerMap) return;
    Image share(frame, {"Y"});
    share.pixels = report.mapShare;
    writePng(mapSharePath(options), toSrgb8(share));
}

std::vector<StageStats> stagesOf(std::vector<StageStats> stages, const ReconstructReport& report) {
    std::erase_if(stages, [](const StageStats& stage) { return stage.name == "reconstruct"; });
    stages.insert(stages.end(), report.stages.begin(), report.stages.end());
    return stages;
}

} // namespace slant::commands

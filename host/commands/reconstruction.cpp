#include "commands/reconstruction.h"

#include "image/png.h"
#include "reconstruct/window.h"

namespace slant::commands {
namespace {

/// Samples per pixel: the average where pixels differ.
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
        .add_option_function<std::string>(
            "--compare", compare, "also run on the CPU, and stop at the first intermediate that differs")
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
    // Makes the CPU cut a picture into chunks that the device can hold.
    constexpr std::uint64_t kBytesPerSample = 2 * sizeof(glm::vec4); // see maxDenseSamples
    if (options.memoryBytes / kBytesPerSample > backend.maxDenseSamples())
        options.memoryBytes = kBytesPerSample * backend.maxDenseSamples();
    return options;
}

void printAgreements(const std::vector<Agreement>& agreements, const Backend& backend) {
    for (const Agreement& agreement : agreements)
        fmt::print("{} intermediates, {} words: {} and cpu agree to the bit\n", agreement.intermediates,
                   agreement.words, backend.name());
}

void addDetails(nlohmann::ordered_json& details, const CommonOptions& common, const LightField& field,
                const Backend& backend, const ReconstructReport& report) {
    const MethodTraits& traits = traitsOf(common.method);
    details.update({{"method", nameOf(common.method)},
                    {"device", backend.name()},
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
    if (traits.makesOutputs()) {
        details["outSpp"] = common.outSpp;
        details["outputs"] = report.outputs;
        if (traits.usesLayerMap) details["layered"] = report.fromMap;
        details["visibility"] = report.search.visibility;
        details["widened"] = report.search.widened;
        details["holes"] = report.search.holes;
        details["overflowed"] = report.search.overflowed;
    }
    if (traits.source == DenseSource::window) {
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

#include "commands/picture_job.h"

#include "base/atomic_file.h"
#include "commands/stats_file.h"
#include "image/png.h"

#include <filesystem>

namespace slant::commands {
namespace {

Metadata metadataOf(const nlohmann::ordered_json& details, const std::vector<StageStats>& stages) {
    Metadata metadata;
    for (const auto& [name, value] : details.items()) {
        if (value.is_string())
            metadata["slant:" + name] = value.get<std::string>();
        else if (value.is_number_float())
            metadata["slant:" + name] = value.get<float>();
        else if (value.is_number_integer() && std::abs(value.get<double>()) < 2147483648.0)
            metadata["slant:" + name] = value.get<int>();
        else
            metadata["slant:" + name] = value.dump();
    }
    for (const StageStats& stage : stages)
        if (stage.seconds > 0) metadata["slant:seconds." + stage.name] = float(stage.seconds);
    return metadata;
}

} // namespace

void addLenientOption(CLI::App& command, ReadOptions& reading) {
    command.add_flag("--lenient", reading.lenient,
                     "put stand-ins where the scene has what is not supported, and say which");
}

void addSceneOptions(CLI::App& command, std::string& scene, ReadOptions& reading) {
    command.add_option("SCENE", scene, "pbrt scene file")->required()->type_name("");
    addLenientOption(command, reading);
}

void addImageOptions(CLI::App& command, PictureOptions& options) {
    command.add_option("--png", options.png, "write an 8-bit sRGB picture too")->type_name("FILE.png");
    addNumber<float>(command, "--exposure", options.exposure, -30, 30,
                     "exposure of the PNG in stops (default 0)");
    command.add_flag("--float", options.float32, "32-bit floats in the EXR instead of half");
    command.add_flag(
        "--auxiliary", options.auxiliary,
        "write coverage, depth, albedo, normals and motion as further channels of the EXR: A, Z, albedo, N, "
        "forward");
}

void addErrorChannelsOption(CLI::App& command, PictureOptions& options) {
    command.add_flag("--error-channels", options.errorChannels,
                     "estimate the error of every pixel and write it as further channels of the EXR: error");
}

void addPictureOptions(CLI::App& command, PictureOptions& options) {
    addSceneOptions(command, options.input, options.reading);
    command.add_option("-o,--output", options.output, "picture to write (default: the film's filename)")
        ->type_name("FILE.exr");
    addImageOptions(command, options);
    addSamplingOptions(command, options.common);
    addRunOptions(command, options.common);
}

std::string mapSharePath(const PictureOptions& options) {
    return std::filesystem::path(options.output).replace_extension(".layer-map.png").string();
}

void checkOutputs(const PictureOptions& options) {
    for (const std::string& path : {options.output, options.png, options.common.statsPath,
                                    options.common.debugLayerMap ? mapSharePath(options) : ""})
        if (!path.empty()) checkWritable(path);
}

Scene readSceneFor(const std::string& path, const ReadOptions& reading, const CommonOptions& options,
                   Monitor& monitor) {
    Scene scene = readScene(path, monitor, reading);
    if (options.spp) scene.pixelSamples = *options.spp;
    if (const auto& crop = options.crop) {
        scene.film.crop = crop->intersect({0, 0, scene.film.xResolution, scene.film.yResolution});
        if (scene.film.crop.empty())
            throw Error(ErrorCode::usage, fmt::format("--crop lies outside the film of {}x{} pixels",
                                                      scene.film.xResolution, scene.film.yResolution));
    }
    return scene;
}

void warnOf(const FieldDefects& defects, std::uint64_t emptyPixels, Monitor& monitor) {
    if (defects.total() > 0)
        monitor.warn(
            fmt::format("invalid samples: {} of non-finite and {} of negative radiance set to 0; {} of "
                        "bad depth, {} outside the lens, {} of bad position and {} of bad motion left "
                        "out; {} would come too near, and their motion is limited",
                        defects.nonFiniteRadiance, defects.negativeRadiance, defects.badDepth,
                        defects.outsideLens, defects.badPosition, defects.badMotion, defects.limitedMotion));
    if (emptyPixels > 0) monitor.warn(fmt::format("{} pixels without a sample are black", emptyPixels));
}

void writeOutputs(const PictureOptions& options, const Image& image, const nlohmann::ordered_json& details,
                  const std::vector<StageStats>& stages, double totalSeconds) {
    if (!options.output.empty())
        writeExr(options.output, image, metadataOf(details, stages),
                 options.float32 ? ExrPrecision::float32 : ExrPrecision::half);
    if (!options.png.empty()) writePng(options.png, toSrgb8(image, options.exposure));
    if (!options.common.statsPath.empty())
        writeStats(options.common.statsPath, stages, totalSeconds, details);
}

} // namespace slant::commands

// What the commands that write pictures share: options, the scene that is read, and the pictures.
#pragma once
#include "base/monitor.h"
#include "commands/options.h"
#include "commands/terminal_monitor.h"
#include "image/exr.h"
#include "lightfield/lightfield.h"
#include "scene/read_scene.h"

#include <nlohmann/json.hpp>
#include <string>

namespace slant::commands {

struct PictureOptions {
    CommonOptions common;
    ReadOptions reading;
    std::string input; ///< scene or light field
    std::string output;
    std::string png;    ///< empty: none
    float exposure = 0; ///< stops, of the PNG
    bool float32 = false;
    bool auxiliary = false;     ///< with further channels: render/auxiliary.h
    bool errorChannels = false; ///< with further channels: render/error_estimate.h
};

/// --lenient
void addLenientOption(CLI::App& command, ReadOptions& reading);
/// SCENE and --lenient
void addSceneOptions(CLI::App& command, std::string& scene, ReadOptions& reading);
/// --png, --exposure, --float, --auxiliary
void addImageOptions(CLI::App& command, PictureOptions& options);
/// --error-channels
void addErrorChannelsOption(CLI::App& command, PictureOptions& options);
/// SCENE, --lenient, -o, those of addImageOptions, and the common options except those of the reconstruction.
void addPictureOptions(CLI::App& command, PictureOptions& options);

/// The file that --debug-image layer-map writes.
std::string mapSharePath(const PictureOptions& options);
/// Throws Error(resources) for outputs that cannot be written, before any work is done.
void checkOutputs(const PictureOptions& options);

/// Reads the scene and applies --crop and --spp.
Scene readSceneFor(const std::string& path, const ReadOptions& reading, const CommonOptions& options,
                   Monitor& monitor);

/// Reports which samples were bad and how many pixels are black because no sample reached them.
void warnOf(const FieldDefects& defects, std::uint64_t emptyPixels, Monitor& monitor);

/// Writes EXR, PNG and statistics. `details` goes into the metadata of the EXR and into the statistics.
void writeOutputs(const PictureOptions& options, const Image& image, const nlohmann::ordered_json& details,
                  const std::vector<StageStats>& stages, double totalSeconds);

} // namespace slant::commands

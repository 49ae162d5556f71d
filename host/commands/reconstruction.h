// What `render` and `reconstruct` share: the way from a light field to its picture.
#pragma once
#include "commands/picture_job.h"

#include "render/field_pictures.h"

#include <nlohmann/json.hpp>
#include <vector>

namespace slant::commands {

/// --compare
void addCompareOption(CLI::App& command, bool& compareWithCpu);

ReconstructOptions reconstructOptions(const CommonOptions& common, const PixelFilter& filter,
                                      const Backend& backend);

/// Reports which pictures agreed with the CPU's.
void printAgreements(const std::vector<Agreement>& agreements, const Backend& backend);

/// Adds how the picture was made to `details`.
void addDetails(nlohmann::ordered_json& details, const CommonOptions& common, const LightField& field,
                const Backend& backend, const ReconstructReport& report);

/// The picture of --debug-image, if it was asked for.
void writeDebugImage(const PictureOptions& options, const Rect& frame, const ReconstructReport& report);

/// `stages` as the monitor saw them, with the reconstruction's stages replaced by those of the report.
std::vector<StageStats> stagesOf(std::vector<StageStats> stages, const ReconstructReport& report);

} // namespace slant::commands

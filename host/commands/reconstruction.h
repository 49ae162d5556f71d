// What `render` and `reconstruct` share: from a light field to its picture.
#pragma once
#include "commands/picture_job.h"

#include "compute/backend.h"

#include <nlohmann/json.hpp>
#include <vector>

namespace slant::commands {

/// --compare
void addCompareOption(CLI::App& command, bool& compareWithCpu);

ReconstructOptions reconstructOptions(const CommonOptions& common, const PixelFilter& filter,
                                      const Backend& backend);

/// The picture of a sanitized field. With compareWithCpu the CPU runs beside the backend, and the first stage
/// that differs is an Error(outOfBounds).
Image reconstruct(Backend& backend, const LightField& field, const ReconstructOptions& options,
                  bool compareWithCpu, Monitor& monitor, ReconstructReport& report);

/// Adds the auxiliary channels to a picture of `field`, whose radiance they overwrite; a stage of `report`.
/// Albedo and normals are left out, with a warning, where the samples have none.
void reconstructAuxiliary(Image& image, Backend& backend, LightField& field,
                          const ReconstructOptions& options, bool compareWithCpu, Monitor& monitor,
                          ReconstructReport& report);

/// Adds to `details` how the picture was made.
void addDetails(nlohmann::ordered_json& details, const CommonOptions& common, const LightField& field,
                const Backend& backend, const ReconstructReport& report);

/// The picture of --debug-image, if it was asked for.
void writeDebugImage(const PictureOptions& options, const Rect& frame, const ReconstructReport& report);

/// `stages` as the monitor saw them, with what the report says of the reconstruction in place of its own.
std::vector<StageStats> stagesOf(std::vector<StageStats> stages, const ReconstructReport& report);

} // namespace slant::commands

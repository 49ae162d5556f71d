// What `render` and `reconstruct` share: from a light field to its picture.
#pragma once
#include "commands/picture_job.h"

#include "compute/backend.h"

#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

namespace slant::commands {

/// --compare
void addCompareOption(CLI::App& command, bool& compareWithCpu);

ReconstructOptions reconstructOptions(const CommonOptions& common, const PixelFilter& filter,
                                      const Backend& backend);

/// The pictures of a field.
class FieldPictures {
public:
    /// The field must be sanitized; both it and the backend must live on. With compareWithCpu the CPU runs
    /// beside the backend, and the first stage that differs is an Error(outOfBounds).
    FieldPictures(Backend& backend, LightField& field, const ReconstructOptions& options,
                  bool compareWithCpu);

    /// R, G, B; `slopeShift` as for PreparedField.
    Image colours(float slopeShift, Monitor& monitor, ReconstructReport& report);
    /// Adds the auxiliary channels to a picture; a stage of `report`. Albedo and normals are left out, with a
    /// warning, where the samples have none.
    void addAuxiliary(Image& image, float slopeShift, Monitor& monitor, ReconstructReport& report);

private:
    void takeRadiances();
    Image picture(float slopeShift, Monitor& monitor, ReconstructReport& report);
    Image pictureAndCompare(float slopeShift, Monitor& monitor, ReconstructReport& report);

    const Backend& backend_;
    LightField& field_;
    std::unique_ptr<PreparedField> prepared_;
    std::unique_ptr<PreparedField> onCpu_; ///< null unless they are to be compared
    std::vector<glm::vec3> colours_;       ///< of the samples, while others are in their place
};

/// Adds to `details` how the picture was made.
void addDetails(nlohmann::ordered_json& details, const CommonOptions& common, const LightField& field,
                const Backend& backend, const ReconstructReport& report);

/// The picture of --debug-image, if it was asked for.
void writeDebugImage(const PictureOptions& options, const Rect& frame, const ReconstructReport& report);

/// `stages` as the monitor saw them, with what the report says of the reconstruction in place of its own.
std::vector<StageStats> stagesOf(std::vector<StageStats> stages, const ReconstructReport& report);

} // namespace slant::commands

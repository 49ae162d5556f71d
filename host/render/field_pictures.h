// The pictures of a light field: colours and auxiliary channels, compared with the CPU's on request.
#pragma once
#include "image/image.h"
#include "lightfield/lens_view.h"
#include "lightfield/value_plane.h"
#include "reconstruct/options.h"
#include "reconstruct/report.h"
#include "render/backend.h"

#include <memory>
#include <vector>

namespace slant {

class PreparedField;

/// Two runs of one picture that agreed to the bit.
struct Agreement {
    std::size_t intermediates = 0, words = 0;
};

class FieldPictures {
public:
    /// The field must be sanitized; both it and the backend must live on. With compareWithCpu the CPU runs
    /// beside the backend, and the first intermediate that differs is an Error(outOfBounds).
    FieldPictures(Backend& backend, const LightField& field, const ReconstructOptions& options,
                  bool compareWithCpu = false);
    ~FieldPictures();

    /// R, G, B. Throws what PreparedField::picture throws.
    Image colours(const LensView& view, Monitor& monitor, ReconstructReport& report);
    /// Adds the auxiliary channels to a picture; a stage of `report`. Albedo and normals are left out, with a
    /// warning, where the samples have none.
    void addAuxiliary(Image& image, const LensView& view, Monitor& monitor, ReconstructReport& report);

    /// One per picture since the last call; none unless they were compared.
    std::vector<Agreement> takeAgreements();

private:
    Image picture(const LensView& view, ValuePlane plane, Monitor& monitor, ReconstructReport& report);
    Image pictureAndCompare(const LensView& view, ValuePlane plane, Monitor& monitor,
                            ReconstructReport& report);

    const LightField& field_;
    std::unique_ptr<PreparedField> prepared_;
    std::unique_ptr<PreparedField> onCpu_; ///< null unless they are to be compared
    std::vector<Agreement> agreements_;
};

} // namespace slant

// Pictures of a light field: the stages of every method in their order, on whatever engine it runs.
#pragma once
#include "image/image.h"
#include "lightfield/lens_view.h"
#include "reconstruct/engine.h"
#include "reconstruct/intermediates.h"

#include <memory>

namespace slant {

/// A field made ready, so that its pictures share what they can: samples are binned only for the first one.
/// Keeps the bins from then on; pictures with other focuses take another 16 bytes per sample.
class PreparedField {
public:
    /// The field must be sanitized, and must live on unchanged.
    template <typename Make>
    PreparedField(const LightField& field, const ReconstructOptions& options, const Make& makeEngine)
        : options_(options), samples_(field, traitsOf(options.method).makesOutputs()),
          engine_(makeEngine(samples_)) {}

    PreparedField(const PreparedField&) = delete;
    PreparedField& operator=(const PreparedField&) = delete;

    /// The picture of field.frame, channels R, G, B: the values of a plane as seen through a lens. `observer`
    /// may be null. Throws Error(usage) for a view that the method cannot have, or another focus unless
    /// options.anyFocus. A picture does not depend on which others are made.
    Image picture(const LensView& view, ValuePlane plane, Monitor& monitor, ReconstructReport& report,
                  IntermediateObserver* observer);

private:
    void filterShading(ReconstructReport& report);
    void bin(const LensView& view, ValuePlane plane, const FilterTable& filter, ReconstructReport& report);

    ReconstructOptions options_;
    SceneSideSamples samples_;
    std::unique_ptr<Engine> engine_;
    std::optional<ValuePlane> binnedPlane_; ///< whose values the bins have; unset: there are none
};

/// A device's way to reconstruct.
class Reconstructor {
public:
    virtual ~Reconstructor() = default;

    /// The field must be sanitized. It must live on unchanged, and so must the reconstructor.
    std::unique_ptr<PreparedField> prepare(const LightField& field, const ReconstructOptions& options) {
        return std::make_unique<PreparedField>(
            field, options, [this](const SceneSideSamples& samples) { return makeEngine(samples); });
    }
    /// A single picture.
    Image reconstruct(const LightField& field, const ReconstructOptions& options, Monitor& monitor,
                      ReconstructReport& report, IntermediateObserver* observer, const LensView& view = {},
                      ValuePlane plane = ValuePlane::radiance) {
        return prepare(field, options)->picture(view, plane, monitor, report, observer);
    }

private:
    virtual std::unique_ptr<Engine> makeEngine(const SceneSideSamples& samples) = 0;
};

/// Throws Error(usage) if a method cannot look through a view.
void checkView(const ReconstructOptions& options, const LensView& view);

} // namespace slant

// The interface of every reconstruction, on whatever device it runs.
#pragma once
#include "base/monitor.h"
#include "image/image.h"
#include "lightfield/lightfield.h"
#include "scene/scene.h"
#include "shared/reconstruct.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace slant {

enum class Method {
    box,       ///< the pixel filter over the input samples: no reconstruction
    window,    ///< reprojection within a fixed window of pixels: what this program grew from, for comparison
    full,      ///< reprojection, apparent surfaces and visibility for every output (Lehtinen et al. 2011)
    automatic, ///< "auto": outputs of blurred surfaces from a layer map, the others as `full`
};
inline constexpr std::size_t kMethodCount = 4;

/// What users call the methods, in the order of Method.
std::span<const std::string> methodNames();
const std::string& nameOf(Method method);
std::optional<Method> parseMethod(std::string_view name);
/// Whether it makes outputs, so that their number matters.
bool usesOutputs(Method method);

/// Of the method `window`; the defaults are those of the program that it is taken from.
struct WindowOptions {
    int rangePx = 4;                    ///< samples of pixels that far away to each side are looked at
    float alpha = 100;                  ///< of the Gaussian exp(-alpha distance^2), per square pixel
    std::optional<float> lensStep = {}; ///< lens radii; unset: 1 / sqrt(samples a pixel)
    bool fill = false; ///< where no sample is near, take the nearest of the window; else the output is black
};

struct ReconstructOptions {
    Method method = Method::automatic;
    int outputsPerPixel = 128; ///< a power of two; `box` has none
    float lensScale = 1;       ///< radius of the aperture over that of the traced one; 0 = pinhole; not `box`
    std::optional<Aperture> aperture; ///< to look through; unset: the traced one; not `box`
    PixelFilter filter;
    WindowOptions window;
    bool anyFocus = false; ///< pictures of other focuses are wanted: PreparedField; not `box`, not `window`
    std::uint64_t seed = 0;
    std::uint64_t memoryBytes = std::uint64_t(1) << 30; ///< for dense samples and lists
};

/// The aperture that outputs look through.
const Aperture& apertureOf(const LightField& field, const ReconstructOptions& options);

/// Dense samples that may be held at a time: half the memory budget.
std::uint64_t maxDenseSamples(const ReconstructOptions& options);

/// Receives what a stage made, in the order in which the stages run, as 32-bit words. CPU and compute report
/// the same stages with the same words, so that the first difference names the stage at fault.
class IntermediateObserver {
public:
    virtual ~IntermediateObserver() = default;
    virtual void stage(const std::string& name, std::span<const uint> words) = 0;
};

/// What a run met and cost.
struct ReconstructReport {
    std::uint64_t outputs = 0;    ///< reconstructed samples
    std::uint64_t fromMap = 0;    ///< of them, those that were taken from the layer map
    std::uint64_t visibility = 0; ///< of them, those that needed apparent surfaces told apart
    std::uint64_t widened = 0; ///< those that found nothing within 2 R (window: and took the nearest sample)
    std::uint64_t holes = 0;   ///< those that found nothing at all and were left out (window: are black)
    std::uint64_t overflowed =
        0; ///< those that met the candidate limit of the compute path and were done on the CPU
    std::uint64_t emptyPixels = 0; ///< pixels that no sample reached
    std::vector<float> mapShare;   ///< of each pixel of the frame, see addMapShare
    std::vector<StageStats> stages;

    /// The stage of that name, made at the end of the list if there is none.
    StageStats& stage(const char* name, const char* unit);
};

/// A field made ready, so that its pictures share what they can: samples are binned for the first of them
/// only. Holds the bins from then on; pictures of other focuses 16 bytes a sample more.
class PreparedField {
public:
    virtual ~PreparedField() = default;
    /// The picture of field.frame, channels R, G, B, from samples whose slopes are `slopeShift` greater than
    /// traced: another focus (lightfield/refocus.h). `observer` may be null. Throws Error(usage) for a shift
    /// unless options.anyFocus. A picture does not depend on which others were made.
    virtual Image picture(float slopeShift, Monitor& monitor, ReconstructReport& report,
                          IntermediateObserver* observer) = 0;
    /// Pictures from now on show the radiances that the samples have by now.
    virtual void takeRadiances() = 0;
};

class Reconstructor {
public:
    virtual ~Reconstructor() = default;
    /// The field must be sanitized and live on, with nothing changed but radiances.
    virtual std::unique_ptr<PreparedField> prepare(const LightField& field,
                                                   const ReconstructOptions& options) = 0;
    /// A single picture, as traced.
    Image reconstruct(const LightField& field, const ReconstructOptions& options, Monitor& monitor,
                      ReconstructReport& report, IntermediateObserver* observer) {
        return prepare(field, options)->picture(0, monitor, report, observer);
    }
};

/// Throws Error(usage) where pictures of the options cannot have that focus.
void checkFocus(const ReconstructOptions& options, float slopeShift);

} // namespace slant

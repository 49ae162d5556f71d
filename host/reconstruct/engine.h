// The part of a reconstruction that a device does. prepared_field.cpp alone has the order of the stages; an
// engine runs them, on the CPU (cpu_engine.h) or in compute shaders (compute/vulkan_engine.h), with the same
// words as results.
#pragma once
#include "camera/lens_distortion.h"
#include "lightfield/scene_side.h"
#include "reconstruct/list_work.h"
#include "reconstruct/motion_grid.h"
#include "reconstruct/options.h"
#include "reconstruct/report.h"
#include "reconstruct/shading_filter.h"
#include "shared/layer_map.h"
#include "shared/window.h"

#include <limits>

namespace slant {

/// The intermediates that stages leave for comparison.
enum class Intermediate {
    bricks,
    cells,
    positions,
    values,
    motions,
    brickMotions,
    layerMap,
    layerMapMotions,
    lensBounds,
    listStart,
    listBricks,
    listClasses,
    missedPixels,
    windowPositions,
    windowValues,
    windowMotions,
    dense,
    film,
};
/// Its name in messages.
const char* nameOf(Intermediate intermediate);

/// What stays the same from chunk to chunk of a picture; the engine keeps it.
struct PictureSetup {
    Rect frame;
    FilterTable filter;
    OutputPattern pattern;     ///< of methods that make outputs
    LensDistortion distortion; ///< of those with a layer map
    SearchKernel search;       ///< of methods that search the bins
    std::uint64_t seed = 0;
    bool observed = false; ///< intermediates are wanted: even what nothing reads is defined
};

/// Of one light field. Stages are called in the order of this list.
class Engine {
public:
    virtual ~Engine() = default;

    /// Dense samples that a buffer holds.
    virtual std::uint64_t maxDenseSamples() const { return std::numeric_limits<std::uint64_t>::max(); }

    // Once for the field, if its method searches bins.
    virtual void bin(const BinScope& scope) = 0;

    // For each picture.
    /// The bins for slopes that are greater than the traced ones by `slopeShift`.
    virtual void refocus(float slopeShift) = 0;
    /// Values for the stages below: of the binned samples, or of `window` and `box`.
    virtual void takeValues(ValuePlane plane) = 0;
    /// Filters the shading of the binned samples, whose radiance was taken last.
    virtual void filterShading(const ShadingPlan& plan) = 0;
    virtual const GridLayout& grid() const = 0;
    virtual const MotionGrid& motion() const = 0;
    /// An empty film.
    virtual void begin(PictureSetup setup) = 0;
    virtual void beginWindow(const WindowSearch& search) = 0;

    // For each band.
    virtual void makeMap(const MapLayout& layout) = 0;

    // For each chunk: lists, classes and outputs from the layer map, outputs from the bins; or outputs from
    // windows; or the input samples, with the values of the bins if there are any. They fill the dense
    // samples. `monitor` advances by outputs.
    virtual void makeLists(const Chunk& chunk) = 0;
    virtual ListClasses lookUpMap(const Chunk& chunk, Monitor& monitor) = 0;
    virtual SearchCounts search(const Chunk& chunk, const ListWork& work, Monitor& monitor) = 0;
    virtual SearchCounts lookThroughWindows(const Chunk& chunk, Monitor& monitor) = 0;
    virtual void takeInput(const Band& band) = 0;

    /// Adds the dense samples to the film: `planes` of them per pixel, those of a lens group after one
    /// another.
    virtual void addToFilm(const Band& band, int planes, int groupSize) = 0;
    /// Sums of weight * rgb and of weight, for each pixel of the frame.
    virtual std::vector<vec4> film() const = 0;

    /// The words that a stage left of a band or chunk, before they are overwritten.
    virtual std::vector<uint> words(Intermediate intermediate) const = 0;
    /// Peak memory of the stages since begin().
    virtual std::uint64_t peakBytes() const = 0;
    /// Times of the device's passes since the last call, if there are any.
    virtual void addPassTimes(ReconstructReport&) {}
};

} // namespace slant

#include "reconstruct/prepared_field.h"

#include "base/error.h"
#include "reconstruct/film_buffer.h"
#include "reconstruct/lens_tiles.h"
#include "reconstruct/map_lookup.h"
#include "reconstruct/window.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace slant {
namespace {

/// Where nothing is blurred by more than this, pixels have so many samples, and the noise of their shading
/// was filtered, `auto` puts the samples themselves through the pixel filter: the first step of the ladder.
/// From fewer samples, or noisy ones, outputs have less error.
constexpr float kSharpPx = 0.1f;
constexpr double kEnoughSamples = 3;

/// One picture: what its stages share.
class Picture {
public:
    Picture(const SceneSideSamples& samples, const ReconstructOptions& options, const LensView& view,
            Engine& engine, Monitor& monitor, ReconstructReport& report, IntermediateObserver* observer)
        : field_(samples.field()), options_(options), view_(view), engine_(engine), monitor_(monitor),
          report_(report), observer_(observer), filter_(makeFilterTable(options.filter)),
          distortion_(distortionOver(outputRegion(field_.frame, filter_), field_.lensMap)),
          maxSamples_(std::min(maxDenseSamples(options), engine.maxDenseSamples())) {}

    const FilterTable& filter() const { return filter_; }

    /// Of input samples: of the pattern, only what engines prepare for.
    void fromInput(OutputPattern pattern = {}) {
        const int planes = int(sampleCounts(field_).max);
        begin(std::move(pattern));
        StageTimer timer(report_, "pixel_filter", "samples");
        timer.items = field_.samples.size();
        for (const Band& band : planBands(field_.frame, filter_, planes, maxSamples_)) {
            engine_.takeInput(band);
            observe(Intermediate::dense);
            engine_.addToFilm(band, planes, 1);
        }
        timer.bytes = engine_.peakBytes();
    }

    void fromWindows() {
        const OutputPattern& pattern = begin(patternFor(0, 0));
        engine_.beginWindow(windowSearch(field_, options_.window));
        observe(Intermediate::windowPositions);
        observe(Intermediate::windowValues);
        if (field_.moves()) observe(Intermediate::windowMotions);
        const Plan plan = planOutputs(field_.frame, filter_, pattern, maxSamples_);
        forEachChunk(
            plan, pattern, [](const Band&) {},
            [&](const Chunk& chunk) {
                report_.search.add(engine_.lookThroughWindows(chunk, monitor_));
                report_.outputs += chunk.outputs();
                return chunk.outputs();
            });
        if (report_.search.holes > 0)
            monitor_.warn(fmt::format("{} of {} outputs are black: nothing in their windows",
                                      report_.search.holes, report_.outputs));
    }

    void fromBins(bool usesMap) {
        for (const Intermediate i :
             {Intermediate::bricks, Intermediate::cells, Intermediate::positions, Intermediate::values})
            observe(i);
        if (field_.moves())
            for (const Intermediate i : {Intermediate::motions, Intermediate::brickMotions}) observe(i);
        const GridLayout& grid = engine_.grid();
        OutputPattern outputs = patternFor(largestSlope(grid), engine_.motion().fastestPx());
        if (usesMap && isSharp()) {
            report_.mapShare.assign(field_.frame.area(), 0.5f); // as where outputs are in focus
            return fromInput(std::move(outputs));
        }
        const OutputPattern& pattern = begin(std::move(outputs));
        const int texels = mapTexelsPerPixel(field_);
        const MotionGrid& motion = engine_.motion();
        const float reach = mapReach(grid, motion, pattern.lensScale, distortion_);
        const int maxRows = usesMap ? mapRows(field_.frame, texels, mapMarginPx(reach, distortion_),
                                              motion.moves(), options_.memoryBytes / 2)
                                    : std::numeric_limits<int>::max();
        const Plan plan = planOutputs(field_.frame, filter_, pattern, maxSamples_, maxRows);
        const auto beginBand = [&](const Band& band) {
            if (usesMap)
                makeMap(
                    chooseMap(grid, motion, band.region, texels, reach, spreadPerPx(pattern), distortion_));
        };
        forEachChunk(plan, pattern, beginBand, [&](const Chunk& chunk) { return search(chunk, usesMap); });
    }

private:
    /// Whether samples with filtered shading show the picture as well as outputs would.
    bool isSharp() const {
        const auto isInFocus = [&](const LightFieldSample& s) { // as it was traced, and as it is looked at
            return !(std::abs(s.slope) > kSharpPx ||
                     view_.apertureScale * std::abs(s.slope + view_.slopeShift) > kSharpPx);
        };
        return traitsOf(options_.method).filtersShading && field_.hasShading() && !field_.moves() &&
               field_.lensMap.empty() && sampleCounts(field_).mean >= kEnoughSamples &&
               std::ranges::all_of(field_.samples, isInFocus);
    }

    OutputPattern patternFor(float slopePx, float velocityPx) const {
        const PatternShutter shutter{field_.moves(), velocityPx, view_.shutterOpen,
                                     view_.shutterClose - view_.shutterOpen};
        return makeOutputPattern(options_.outputsPerPixel, slopePx, view_.apertureScale,
                                 view_.apertureOf(field_), shutter);
    }

    const OutputPattern& begin(OutputPattern pattern) {
        pattern_ = std::move(pattern);
        engine_.begin({field_.frame, filter_, pattern_, distortion_, traitsOf(options_.method).search,
                       options_.seed, observer_ != nullptr});
        return pattern_;
    }

    void makeMap(const MapLayout& layout) {
        StageTimer timer(report_, "layer_map", "texels");
        engine_.makeMap(layout);
        timer.items = levelBegin(layout, layout.levels);
        timer.bytes = engine_.peakBytes();
        observe(Intermediate::layerMap);
        if (field_.moves()) observe(Intermediate::layerMapMotions);
    }

    /// Returns how many outputs were made.
    std::uint64_t search(const Chunk& chunk, bool usesMap) {
        engine_.makeLists(chunk);
        if (!field_.lensMap.empty()) observe(Intermediate::lensBounds);
        observe(Intermediate::listStart);
        observe(Intermediate::listBricks);
        const auto tiles = std::size_t(chunk.layout.tileCount.x) * std::size_t(chunk.layout.tileCount.y);
        ListClasses classes(tiles * std::size_t(chunk.groupCount));
        if (usesMap) {
            classes = engine_.lookUpMap(chunk, monitor_);
            observe(Intermediate::listClasses);
            observe(Intermediate::missedPixels);
            addMapShare(report_.mapShare, field_.frame, chunk.band, classes, pattern_.groups.size());
        }
        const ListWork work = listWork(classes, chunk, pattern_);
        report_.search.add(engine_.search(chunk, work, monitor_));
        report_.fromMap += work.fromMap;
        report_.outputs += work.outputs;
        return work.outputs;
    }

    /// Runs through bands, and in each through the chunks that `make` fills with outputs; `make` returns how
    /// many.
    template <typename BeginBand, typename Make>
    void forEachChunk(const Plan& plan, const OutputPattern& pattern, const BeginBand& beginBand,
                      const Make& make) {
        monitor_.beginStage("reconstruct", plan.outputs, "outputs");
        for (const Band& band : plan.bands) {
            beginBand(band);
            for (const Chunk& chunk : chunksOf(plan, band, pattern, options_.seed)) {
                {
                    StageTimer timer(report_, "reconstruct", "outputs");
                    timer.items = make(chunk);
                    timer.bytes = engine_.peakBytes();
                    observe(Intermediate::dense);
                }
                StageTimer timer(report_, "pixel_filter", "outputs");
                timer.items = chunk.outputs();
                engine_.addToFilm(band, chunk.planes, pattern.groupSize());
            }
        }
        monitor_.endStage();
    }

    void observe(Intermediate intermediate) const {
        if (observer_) observer_->receive(nameOf(intermediate), engine_.words(intermediate));
    }

    const LightField& field_;
    const ReconstructOptions& options_;
    const LensView& view_;
    Engine& engine_;
    Monitor& monitor_;
    ReconstructReport& report_;
    IntermediateObserver* observer_;
    FilterTable filter_;
    LensDistortion distortion_;
    std::uint64_t maxSamples_;
    OutputPattern pattern_;
};

} // namespace

Image PreparedField::picture(const LensView& view, ValuePlane plane, Monitor& monitor,
                             ReconstructReport& report, IntermediateObserver* observer) {
    checkView(options_, view);
    Picture picture(samples_, options_, view, *engine_, monitor, report, observer);
    const MethodTraits& traits = traitsOf(options_.method);
    if (traits.source == DenseSource::bins)
        bin(view, plane, picture.filter(), report);
    else
        engine_->takeValues(plane);
    switch (traits.source) {
    case DenseSource::input:
        picture.fromInput();
        break;
    case DenseSource::window:
        picture.fromWindows();
        break;
    case DenseSource::bins:
        picture.fromBins(traits.usesLayerMap);
        break;
    }
    engine_->addPassTimes(report);
    if (observer) observer->receive(nameOf(Intermediate::film), engine_->words(Intermediate::film));
    return filmImage(samples_.field().frame, engine_->film(), report.emptyPixels);
}

/// Stage "shading".
void PreparedField::filterShading(ReconstructReport& report) {
    StageTimer timer(report, "shading", "samples");
    timer.items = samples_.samples().size();
    engine_->filterShading(planShading(samples_.field(), engine_->grid(), options_.memoryBytes / 2));
    timer.bytes = engine_->peakBytes();
}

/// Stages "bin", unless it is done, and "refocus".
void PreparedField::bin(const LensView& view, ValuePlane plane, const FilterTable& filter,
                        ReconstructReport& report) {
    if (binnedPlane_ != plane) {
        {
            StageTimer timer(report, "bin", "samples");
            timer.items = samples_.samples().size();
            if (!binnedPlane_) engine_->bin({searchRegionOf(samples_, filter), options_.anyFocus});
            engine_->takeValues(plane);
            binnedPlane_ = plane;
            timer.bytes = engine_->peakBytes();
        }
        if (plane == ValuePlane::radiance && traitsOf(options_.method).filtersShading &&
            samples_.field().hasShading())
            filterShading(report);
    }
    if (view.slopeShift == 0) return engine_->refocus(0);
    StageTimer timer(report, "refocus", "samples");
    timer.items = samples_.samples().size();
    engine_->refocus(view.slopeShift);
}

void checkView(const ReconstructOptions& options, const LensView& view) {
    const MethodTraits& traits = traitsOf(options.method);
    if (view.slopeShift != 0 && !traits.refocuses())
        throw Error(
            ErrorCode::usage,
            fmt::format("method {} looks for samples in their own pixels, which another focus moves them out "
                        "of; choose another",
                        traits.name));
    if (view.slopeShift != 0 && !options.anyFocus)
        throw Error(ErrorCode::usage,
                    fmt::format("method {} was prepared for the traced focus only", traits.name));
    if (!view.isTracedShutter() && !traits.makesOutputs())
        throw Error(ErrorCode::usage,
                    fmt::format("method {} takes the traced shutter only; choose another", traits.name));
    if (!view.isTracedShutter() && !traits.refocuses())
        throw Error(ErrorCode::usage,
                    fmt::format("method {} looks for samples in their own pixels, which another time moves "
                                "them out of; choose another",
                                traits.name));
    if (!view.isTracedLens() && !traits.makesOutputs())
        throw Error(ErrorCode::usage,
                    fmt::format("method {} takes the traced lens only; choose another", traits.name));
}

const char* nameOf(Intermediate intermediate) {
    constexpr std::array kNames{"bin.bricks",    "bin.cells",
                                "bin.positions", "bin.values",
                                "bin.motions",   "bin.brickMotions",
                                "layer_map",     "layer_map.motions",
                                "lists.lens",    "lists.start",
                                "lists.bricks",  "list_classes",
                                "missed",        "window.positions",
                                "window.values", "window.motions",
                                "dense",         "film"};
    return kNames.at(std::size_t(intermediate));
}

} // namespace slant

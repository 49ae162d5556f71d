#include "report/sweep.h"

#include "base/error.h"
#include "base/hash.h"
#include "base/parallel.h"
#include "image/flip.h"
#include "image/heat_map.h"
#include "image/metrics.h"
#include "image/png.h"
#include "reconstruct/prepared_field.h"
#include "render/adaptive.h"
#include "render/brute_force.h"
#include "report/machine.h"
#include "report/timing.h"
#include "report/truth.h"
#include "report/work_monitor.h"
#include "scene/read_scene.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <tuple>

namespace slant {
namespace {

namespace fs = std::filesystem;

constexpr int kPicturedSpp = 8;   ///< pictures of methods are from this many samples, if the sweep has them
constexpr double kMapScale = 0.4; ///< FLIP that is the brightest colour of the maps
constexpr const char* kAdaptive = " adaptive"; ///< behind the names of methods whose samples are placed

int halved(int pixels) {
    return (pixels + 1) / 2;
}

/// The scene at half the resolution in both directions; if a size is odd, the last half pixel becomes a whole
/// one and the screen window grows by it.
void halve(Scene& scene) {
    Film& film = scene.film;
    PerspectiveCamera& camera = scene.camera;
    const glm::vec2 extent = camera.screenMax - camera.screenMin;
    const glm::ivec2 before(film.xResolution, film.yResolution), after(halved(before.x), halved(before.y));
    camera.screenMax.x = camera.screenMin.x + extent.x * float(2 * after.x) / float(before.x);
    camera.screenMin.y = camera.screenMax.y - extent.y * float(2 * after.y) / float(before.y);
    film.xResolution = after.x;
    film.yResolution = after.y;
    film.crop = {film.crop.x0 / 2, film.crop.y0 / 2, halved(film.crop.x1), halved(film.crop.y1)};
}

std::string nameOf(const std::string& path) {
    return fs::path(path).stem().string();
}

/// The sweep over one scene at a time.
class Sweep {
public:
    Sweep(const SweepOptions& options, const std::vector<Point>& known,
          const std::function<void(const Results&)>& onPoint, Monitor& monitor)
        : options_(options), known_(known), onPoint_(onPoint), monitor_(monitor), work_(monitor) {
        std::set<std::string> names;
        for (const std::string& path : options.scenes) {
            if (!names.insert(nameOf(path)).second)
                throw Error(ErrorCode::usage, fmt::format("two scenes are called '{}'", nameOf(path)));
            scenes_.push_back(readScene(path, monitor, options.reading));
            if (options.halfSize) halve(scenes_.back());
        }
        std::set<std::string> deviceNames;
        for (const std::string& device : options.devices) {
            backends_.push_back(std::make_unique<Backend>(device, options.threads));
            if (!deviceNames.insert(backends_.back()->name()).second)
                throw Error(ErrorCode::usage, fmt::format("two devices are '{}'", backends_.back()->name()));
        }
    }

    Results run() {
        std::uint64_t total = 0;
        for (const Scene& scene : scenes_) total += workOf(scene);
        monitor_.beginStage("chart", total, "samples");
        for (const Scene& scene : scenes_) runScene(scene);
        work_.endShare();
        monitor_.endStage();
        std::ranges::stable_sort(results_.points, {}, [&](const Point& p) { return orderOf(p); });
        return std::move(results_);
    }

private:
    int outputsOf(Method method, int outputs) const { return traitsOf(method).makesOutputs() ? outputs : 0; }

    /// All settings of the methods from `spp` samples, device by device.
    template <typename Visit>
    void forEachSetting(const Visit& visit) const {
        for (const auto& backend : backends_)
            for (const Method method : options_.methods)
                for (const int outputs : options_.outputs) {
                    visit(*backend, method, outputs);
                    if (!traitsOf(method).makesOutputs()) break;
                }
    }

    // Work is counted in samples, traced or reconstructed, which all cost about the same.

    std::uint64_t shareOf(const Scene& scene, std::uint64_t samplesPerPixel, int runs) const {
        return scene.film.crop.area() * samplesPerPixel * std::uint64_t(runs);
    }

    bool placesSamples(const Scene& scene, int spp) const {
        return firstPassSamples(spp, options_.placedShare) < spp && !scene.realistic;
    }

    std::uint64_t workOf(const Scene& scene) const {
        std::uint64_t work = shareOf(scene, std::uint64_t(options_.truthSpp), 1);
        for (const int spp : options_.samples) {
            work += shareOf(scene, std::uint64_t(spp), options_.repeat + 1);
            forEachSetting([&](const Backend&, Method method, int outputs) {
                const auto made = std::uint64_t(outputsOf(method, outputs));
                work += shareOf(scene, made, options_.repeat + 1);
                if (placesSamples(scene, spp))
                    work += shareOf(scene, made + std::uint64_t(spp), options_.repeat + 1);
            });
        }
        for (const int spp : referenceSamples(options_.truthSpp))
            work += shareOf(scene, std::uint64_t(spp), options_.repeat + 1);
        return work;
    }

    void beginShare(const Scene& scene, std::uint64_t samplesPerPixel, int runs) {
        work_.beginShare(shareOf(scene, samplesPerPixel, runs), nameOf(scene.path) + ": ");
    }

    void runScene(const Scene& scene) {
        work_.beginShare(0, nameOf(scene.path) + ": ");
        const Tracer tracer(scene, work_);
        const std::string content = contentKey(scene, tracer);
        beginShare(scene, std::uint64_t(options_.truthSpp), 1);
        const Image truth = groundTruth(scene, tracer, content, options_.truthSpp, options_.seed,
                                        options_.cacheDirectory, work_);
        SceneSummary summary{nameOf(scene.path), scene.path,
                             truth.width(),      truth.height(),
                             options_.truthSpp,  "images/" + nameOf(scene.path) + "-truth.png"};
        writePng(pathOf(summary.truthPicture), toSrgb8(truth, options_.exposure));
        results_.scenes.push_back(summary);
        for (const int spp : options_.samples) runMethods(scene, tracer, content, truth, spp);
        for (const int spp : options_.samples)
            if (placesSamples(scene, spp)) runAdaptive(scene, tracer, content, truth, spp);
        for (const int spp : referenceSamples(options_.truthSpp))
            runReference(scene, tracer, content, truth, spp);
    }

    SampleOptions samplingOf(const Scene& scene, int spp) const {
        const bool filtered = std::ranges::any_of(
            options_.methods, [](Method method) { return traitsOf(method).filtersShading; });
        return {.samplesPerPixel = spp,
                .seed = options_.seed,
                .planes = {.shading = filtered && hasShadingNoise(scene),
                           .shadows = filtered && hasSoftShadows(scene)}};
    }

    ReconstructOptions reconstructionOf(const Scene& scene, Method method, int outputs) const {
        ReconstructOptions reconstruction;
        reconstruction.method = method;
        reconstruction.outputsPerPixel = outputs;
        reconstruction.filter = scene.filter;
        reconstruction.seed = options_.seed;
        return reconstruction;
    }

    /// Every method and setting from one light field of `spp` samples, which is traced only if it is needed.
    void runMethods(const Scene& scene, const Tracer& tracer, const std::string& content, const Image& truth,
                    int spp) {
        LightField field;
        Timing trace;
        beginShare(scene, std::uint64_t(spp), options_.repeat + 1);
        forEachSetting([&](Backend& backend, Method method, int outputs) {
            Point point = newPoint(scene, content, slant::nameOf(method), spp, outputsOf(method, outputs),
                                   backend.name());
            if (takeKnown(point)) return;
            if (field.samples.empty())
                trace = timeRuns(options_.repeat, [&] {
                    field = {};
                    field = traceField(tracer, scene, samplingOf(scene, spp), work_).field;
                });
            point.traceSeconds = trace.seconds;
            measure(point, scene, backend, method, outputs, field, truth);
        });
    }

    /// The same with a share of the samples placed where the method's picture has most error.
    void runAdaptive(const Scene& scene, const Tracer& tracer, const std::string& content, const Image& truth,
                     int spp) {
        const SampleOptions sampling = samplingOf(scene, firstPassSamples(spp, options_.placedShare));
        forEachSetting([&](Backend& backend, Method method, int outputs) {
            Point point = newPoint(scene, content, slant::nameOf(method) + kAdaptive, spp,
                                   outputsOf(method, outputs), backend.name());
            beginShare(scene, std::uint64_t(spp), options_.repeat + 1);
            if (takeKnown(point)) return;
            TracedField traced;
            const ReconstructOptions reconstruction = reconstructionOf(scene, method, outputs);
            point.traceSeconds = timeRuns(options_.repeat, [&] {
                                     traced = {};
                                     SamplePlacement placement(tracer, sampling, traced, work_);
                                     traced = traceField(tracer, scene, sampling, work_);
                                     ReconstructReport report;
                                     std::vector<Agreement> agreements;
                                     const ErrorEstimate error(backend, traced.field, reconstruction, {},
                                                               false, work_, report, agreements);
                                     placement.add(error, scene.film.crop.area() *
                                                              std::uint64_t(spp - sampling.samplesPerPixel));
                                 }).seconds;
            measure(point, scene, backend, method, outputs, traced.field, truth);
        });
    }

    /// Finishes the point of a field that is traced.
    void measure(Point& point, const Scene& scene, const Backend& backend, Method method, int outputs,
                 const LightField& field, const Image& truth) {
        beginShare(scene, std::uint64_t(point.outputs), options_.repeat + 1);
        const ReconstructOptions reconstruction = reconstructionOf(scene, method, outputs);
        Image image;
        const Timing timing = timeRuns(options_.repeat, [&] {
            ReconstructReport report;
            image = backend.reconstructor().reconstruct(field, reconstruction, work_, report, nullptr);
        });
        point.reconstructSeconds = timing.seconds;
        point.runs = timing.runs;
        finish(point, image, truth);
    }

    void runReference(Scene scene, const Tracer& tracer, const std::string& content, const Image& truth,
                      int spp) {
        scene.pixelSamples = spp;
        beginShare(scene, std::uint64_t(spp), options_.repeat + 1);
        Point point = newPoint(scene, content, kReference, spp, 0, "cpu");
        if (takeKnown(point)) return;
        Image image;
        const Timing timing =
            timeRuns(options_.repeat, [&] { image = bruteForce(scene, tracer, options_.seed, work_).image; });
        point.traceSeconds = timing.seconds;
        point.runs = timing.runs;
        finish(point, image, truth);
    }

    Point newPoint(const Scene& scene, const std::string& content, const std::string& method, int spp,
                   int outputs, const std::string& device) const {
        Point point;
        point.scene = nameOf(scene.path);
        point.method = method;
        point.spp = spp;
        point.outputs = outputs;
        point.device = device;
        if (isPictured(point)) {
            std::string stem = fmt::format("images/{}-{}-{}", point.scene, method, spp);
            if (outputs > 0) stem += fmt::format("-{}", outputs);
            point.picture = stem + ".png";
            point.map = stem + "-flip.png";
        }
        Hash hash;
        for (const std::string& text : {point.scene, content, method, device, program_, machine_})
            hash.add(text);
        for (const int number : {spp, outputs, options_.repeat, options_.truthSpp, threadCount()})
            hash.add(number);
        hash.add(options_.seed);
        hash.add(options_.placedShare);
        hash.add(options_.exposure);
        point.key = hash.hex();
        return point;
    }

    /// The reference always, so that a picture of equal time can be shown; of the methods one setting each.
    bool isPictured(const Point& point) const {
        if (point.isReference()) return true;
        const auto& samples = options_.samples;
        const bool hasUsual = std::ranges::find(samples, kPicturedSpp) != samples.end();
        return point.spp == (hasUsual ? kPicturedSpp : samples[samples.size() / 2]) &&
               point.device == backends_.front()->name() &&
               (point.outputs == 0 || point.outputs == options_.outputs.back());
    }

    /// Takes over the point if an earlier run has measured it and left its pictures; false if not.
    bool takeKnown(const Point& point) {
        const auto found = std::ranges::find(known_, point.key, &Point::key);
        if (found == known_.end()) return false;
        const bool pictured = found->picture == point.picture && fs::exists(pathOf(point.picture)) &&
                              fs::exists(pathOf(point.map));
        if (!point.picture.empty() && !pictured) return false;
        Point& taken = results_.points.emplace_back(*found);
        taken.picture = point.picture;
        taken.map = point.map;
        return true;
    }

    void finish(Point point, const Image& image, const Image& truth) {
        const Metrics metrics = compare(image, truth);
        const Flip perceived = flip(image, truth, {.exposureStops = options_.exposure});
        point.mse = metrics.mse;
        point.relMse = metrics.relMse;
        point.flip = perceived.mean;
        point.drift = metrics.drift;
        if (!point.picture.empty()) {
            writePng(pathOf(point.picture), toSrgb8(image, options_.exposure));
            const Image none(perceived.map.dataWindow, perceived.map.channels);
            writePng(pathOf(point.map), heatMap(perceived.map, none, kMapScale));
        }
        results_.points.push_back(std::move(point));
        onPoint_(results_);
    }

    /// Curve after curve, brute force last.
    std::tuple<std::size_t, std::size_t, std::string, int, int> orderOf(const Point& p) const {
        const auto scene = std::ranges::find(results_.scenes, p.scene, &SceneSummary::name);
        const bool adaptive = p.method.ends_with(kAdaptive);
        const std::string name = adaptive ? p.method.substr(0, p.method.rfind(kAdaptive)) : p.method;
        const auto method = std::ranges::find(methodNames(), name);
        return {std::size_t(scene - results_.scenes.begin()),
                2 * std::size_t(method - methodNames().begin()) + (adaptive ? 1 : 0), p.device, p.outputs,
                p.spp};
    }

    std::string pathOf(const std::string& file) const {
        return (fs::path(options_.pictureDirectory) / file).string();
    }

    const SweepOptions& options_;
    const std::vector<Point>& known_;
    const std::function<void(const Results&)>& onPoint_;
    Monitor& monitor_;
    WorkMonitor work_;
    const std::string program_ = programDigest(), machine_ = machineName();
    std::vector<Scene> scenes_;
    std::vector<std::unique_ptr<Backend>> backends_;
    Results results_;
};

} // namespace

std::vector<int> referenceSamples(int truthSpp) {
    std::vector<int> counts;
    for (int spp = 4; spp <= truthSpp / 4; spp *= 4) counts.push_back(spp);
    return counts;
}

Results runSweep(const SweepOptions& options, const std::vector<Point>& known,
                 const std::function<void(const Results&)>& onPoint, Monitor& monitor) {
    return Sweep(options, known, onPoint, monitor).run();
}

} // namespace slant

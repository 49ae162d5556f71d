#include "report/truth.h"

#include "base/error.h"
#include "base/hash.h"
#include "base/read_file.h"
#include "image/exr.h"
#include "render/brute_force.h"

#include <cstdlib>
#include <filesystem>
#include <optional>

namespace slant {
namespace {

constexpr int kProbeRows = 16; ///< one in this many rows of the film is probed

/// A seed that differs from those of the runs that are measured against the truth.
std::uint64_t truthSeed(std::uint64_t seed) {
    return seed ^ 0x9e3779b97f4a7c15;
}

std::optional<Image> readCached(const std::string& path, const Rect& crop, Monitor& monitor) {
    if (!std::filesystem::exists(path)) return {};
    try {
        Image image = readExr(path).image;
        if (image.dataWindow == crop && image.channels == std::vector<std::string>{"R", "G", "B"})
            return image;
        monitor.warn(path + ": is not the ground truth that its name says; it is made again");
    } catch (const Error& error) {
        monitor.warn(fmt::format("{}; it is made again", error.what()));
    }
    return {};
}

} // namespace

std::string contentKey(const Scene& scene, const Tracer& tracer) {
    Hash hash;
    for (const std::string& file : scene.files) hash.add(readFile(file));
    const Film& film = scene.film;
    for (const int number : {film.xResolution, film.yResolution, film.crop.x0, film.crop.y0, film.crop.x1,
                             film.crop.y1, int(scene.filter.kind)})
        hash.add(number);
    for (const float number : {scene.filter.radius.x, scene.filter.radius.y, scene.filter.sigma,
                               scene.filter.b, scene.filter.c, scene.filter.tau})
        hash.add(number);
    SilentMonitor silent;
    for (int y = film.crop.y0; y < film.crop.y1; y += kProbeRows) {
        const Rect row{film.crop.x0, y, film.crop.x1, y + 1};
        SampleSet set;
        set.resize(row.area(), {});
        tracer.trace(row, {.count = 1}, 1, 0, spansOf(set), silent);
        for (std::size_t i = 0; i < set.samples.size(); ++i) {
            const LightFieldSample& s = set.samples[i];
            const glm::vec3& rgb = set.radiance[i];
            for (const float value : {s.x, s.y, s.u, s.v, s.w, s.slope, rgb.r, rgb.g, rgb.b}) hash.add(value);
        }
    }
    return hash.hex();
}

Image groundTruth(Scene scene, const Tracer& tracer, const std::string& contentKey, int spp,
                  std::uint64_t seed, const std::string& directory, Monitor& monitor) {
    const std::string stem = std::filesystem::path(scene.path).stem().string();
    const std::string path = (std::filesystem::path(directory) /
                              fmt::format("{}-{}-{}-{:x}.exr", stem, contentKey, spp, truthSeed(seed)))
                                 .string();
    if (std::optional<Image> cached = readCached(path, scene.film.crop, monitor)) return std::move(*cached);
    scene.pixelSamples = spp;
    BruteForce truth = bruteForce(scene, tracer, truthSeed(seed), monitor);
    if (truth.defects.total() > 0 || truth.emptyPixels > 0)
        monitor.warn(fmt::format("the ground truth met {} invalid samples and has {} empty pixels",
                                 truth.defects.total(), truth.emptyPixels));
    makeDirectory(directory);
    writeExr(path, truth.image, {{"slant:scene", scene.path}, {"slant:spp", spp}}, ExrPrecision::float32);
    return std::move(truth.image);
}

std::string defaultCacheDirectory() {
    // The specification says to ignore relative paths.
    if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache && *cache == '/')
        return (std::filesystem::path(cache) / "slant").string();
    if (const char* home = std::getenv("HOME"); home && *home)
        return (std::filesystem::path(home) / ".cache" / "slant").string();
    throw Error(ErrorCode::usage, "there is no cache directory: neither XDG_CACHE_HOME nor HOME is set (see "
                                  "--cache)");
}

void makeDirectory(const std::string& path) {
    std::error_code error;
    std::filesystem::create_directories(path, error);
    if (error || !std::filesystem::is_directory(path))
        throw Error(ErrorCode::resources, {path},
                    fmt::format("cannot make this directory: {}",
                                error ? error.message() : std::string("there is a file of that name")));
}

} // namespace slant

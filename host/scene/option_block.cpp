#include "scene/option_block.h"

#include "base/monitor.h"
#include "base/suggest.h"
#include "scene/lens_file.h"
#include "scene/scene_files.h"
#include "scene/spelling.h"
#include "scene/transforms.h"

#include <algorithm>
#include <cmath>

namespace slant {
namespace {

constexpr int kMaxResolution = 1 << 20;
constexpr std::int64_t kMaxPixels = std::int64_t(1) << 28;
constexpr int kMaxPixelSamples = 1 << 20;
constexpr int kMaxPathDepth = 10000;
constexpr float kMaxFilterRadiusPx = 128;

constexpr std::string_view kFilters[] = {"box", "triangle", "gaussian", "mitchell", "sinc"};
constexpr std::string_view kSamplers[] = {"halton",     "independent", "paddedsobol", "sobol",
                                          "stratified", "zsobol",      "pmj02bn"};
constexpr std::string_view kCameras[] = {"perspective", "realistic", "orthographic", "spherical"};
constexpr std::string_view kIntegrators[] = {"path", "volpath"};

/// Throws unless `kind` is one of `kinds`.
void checkKind(std::string_view family, const std::string& kind, std::span<const std::string_view> kinds,
               const ParameterList& parameters) {
    if (std::find(kinds.begin(), kinds.end(), kind) == kinds.end())
        throw badInput(parameters.position(), "{} \"{}\" is not supported{}", family, printable(kind),
                       didYouMean(kind, kinds));
}

Rect pixelBounds(const Film& film, ParameterList& parameters, Monitor& monitor) {
    const Rect whole{0, 0, film.xResolution, film.yResolution};
    const std::vector<int> bounds = parameters.integers("pixelbounds");
    if (bounds.empty()) return whole;
    const Position where = parameters.positionOf("pixelbounds");
    if (bounds.size() != 4) throw badInput(where, "'pixelbounds' needs four numbers: x0, x1, y0, y1");
    const Rect asked{bounds[0], bounds[2], bounds[1], bounds[3]};
    if (asked.intersect(whole) != asked)
        monitor.warn(FileLocation(where).text() +
                     ": 'pixelbounds' reach beyond the film and are clipped to it");
    return asked.intersect(whole);
}

/// In floats like pbrt, so that the bounds round to the same pixels.
Rect cropped(const Film& film, const std::vector<float>& window, const Position& where) {
    if (window.size() != 4) throw badInput(where, "'cropwindow' needs four numbers: x0, x1, y0, y1");
    const auto pixel = [](int resolution, float a) {
        return int(std::ceil(float(resolution) * std::clamp(a, 0.f, 1.f)));
    };
    return {pixel(film.xResolution, std::min(window[0], window[1])),
            pixel(film.yResolution, std::min(window[2], window[3])),
            pixel(film.xResolution, std::max(window[0], window[1])),
            pixel(film.yResolution, std::max(window[2], window[3]))};
}

Film readFilm(const std::string& kind, ParameterList& parameters, float exposureTime, Monitor& monitor) {
    checkKind("film", kind, std::array<std::string_view, 1>{"rgb"}, parameters);
    Film film;
    film.xResolution = parameters.integer("xresolution", 1280, 1, kMaxResolution);
    film.yResolution = parameters.integer("yresolution", 720, 1, kMaxResolution);
    if (std::int64_t(film.xResolution) * film.yResolution > kMaxPixels)
        throw badInput(parameters.position(), "{}x{} pixels are more than the limit of {}", film.xResolution,
                       film.yResolution, kMaxPixels);
    film.crop = pixelBounds(film, parameters, monitor);
    if (const std::vector<float> window = parameters.numbers("cropwindow"); !window.empty())
        film.crop = cropped(film, window, parameters.positionOf("cropwindow"));
    if (film.crop.empty()) throw badInput(parameters.position(), "the crop leaves no pixel of the film");
    film.filename = parameters.text("filename").value_or(film.filename);
    parameters.choice("sensor", "cie1931", {"cie1931"});
    if (parameters.number("whitebalance", 0) != 0)
        throw badInput(parameters.positionOf("whitebalance"), "'whitebalance' other than 0 is not supported");
    film.imagingRatio = exposureTime * parameters.number("iso", 100, kPositive) / 100;
    film.maxComponentValue = parameters.number("maxcomponentvalue", kPositive).value_or(0);
    film.diagonalMm = parameters.number("diagonal", 35, kPositive);
    parameters.ignore({"savefp16"});
    parameters.finish();
    return film;
}

PixelFilter readFilter(const std::string& kind, ParameterList& parameters) {
    struct Default {
        std::string_view name;
        FilterKind kind;
        float radius;
    };
    constexpr Default kDefaults[] = {{"box", FilterKind::box, 0.5f},
                                     {"triangle", FilterKind::triangle, 2},
                                     {"gaussian", FilterKind::gaussian, 1.5f},
                                     {"mitchell", FilterKind::mitchell, 2},
                                     {"sinc", FilterKind::sinc, 4}};
    checkKind("pixel filter", kind, kFilters, parameters);
    PixelFilter filter;
    for (const Default& entry : kDefaults)
        if (entry.name == kind) {
            const Range range{0, kMaxFilterRadiusPx, true};
            filter.kind = entry.kind;
            filter.radius = {parameters.number("xradius", entry.radius, range),
                             parameters.number("yradius", entry.radius, range)};
        }
    if (filter.kind == FilterKind::gaussian) filter.sigma = parameters.number("sigma", 0.5f, kPositive);
    if (filter.kind == FilterKind::mitchell) {
        filter.b = parameters.number("B", 1.f / 3);
        filter.c = parameters.number("C", 1.f / 3);
    }
    if (filter.kind == FilterKind::sinc) filter.tau = parameters.number("tau", 3, kPositive);
    parameters.finish();
    return filter;
}

PerspectiveCamera readShutter(const std::string& kind, ParameterList& parameters) {
    checkKind("camera", kind, kCameras, parameters);
    PerspectiveCamera camera;
    camera.shutterOpen = parameters.number("shutteropen", 0);
    camera.shutterClose = parameters.number("shutterclose", 1);
    if (camera.shutterClose <= camera.shutterOpen)
        throw badInput(parameters.position(),
                       "the shutter never opens: 'shutterclose' must be after 'shutteropen'");
    return camera;
}

ApertureShape readShape(ParameterList& parameters, const SceneFiles& files) {
    const std::optional<std::string> aperture = parameters.text("aperture");
    return aperture ? files.aperture(*aperture, parameters.positionOf("aperture")) : ApertureShape();
}

void readPerspective(PerspectiveCamera& camera, ParameterList& parameters, const SceneFiles& files) {
    if (camera.projection == Projection::perspective)
        camera.fovDegrees = parameters.number("fov", 90, {0, 179.99, true});
    camera.lensRadius = parameters.number("lensradius", 0, kNonNegative);
    camera.focalDistance = parameters.number("focaldistance", 1e6f, kPositive);
    camera.aperture = readShape(parameters, files);
}

void readSpherical(PerspectiveCamera& camera, ParameterList& parameters) {
    camera.projection =
        parameters.choice("mapping", "equalarea", {"equalarea", "equirectangular"}) == "equalarea"
            ? Projection::equalArea
            : Projection::equirectangular;
    // As in pbrt.
    parameters.ignore({"lensradius", "focaldistance", "frameaspectratio", "screenwindow"});
}

RealisticCamera readRealistic(ParameterList& parameters, const SceneFiles& files, const std::string& path,
                              Monitor& monitor) {
    RealisticCamera camera;
    camera.lens = readLens(path, parameters.positionOf("lensfile"));
    camera.aperture = readShape(parameters, files);
    camera.apertureDiameterMm = parameters.number("aperturediameter", 1, kPositive);
    camera.focusDistance = parameters.number("focusdistance", 10, kPositive);
    camera.focusLocation = parameters.positionOf("focusdistance");
    if (const double widest = camera.lens.surfaces[camera.lens.stop].diameter;
        camera.apertureDiameterMm > widest) {
        if (camera.apertureDiameterMm > double(float(widest)))
            monitor.warn(
                fmt::format("{}: 'aperturediameter' is {} mm, but the stop of {} opens to {} mm only",
                            FileLocation(parameters.positionOf("aperturediameter")).text(),
                            camera.apertureDiameterMm, path, widest));
        camera.apertureDiameterMm = widest;
    }
    return camera;
}

/// The screen window: given, or [-1, 1] along the shorter axis.
void readScreen(PerspectiveCamera& camera, ParameterList& parameters, const Film& film) {
    const float aspect =
        parameters.number("frameaspectratio", float(film.xResolution) / float(film.yResolution), kPositive);
    camera.screenMax = aspect > 1 ? glm::vec2(aspect, 1) : glm::vec2(1, 1 / aspect);
    camera.screenMin = -camera.screenMax;
    if (const std::vector<float> window = parameters.numbers("screenwindow"); !window.empty()) {
        const Position where = parameters.positionOf("screenwindow");
        if (window.size() != 4) throw badInput(where, "'screenwindow' needs four numbers: x0, x1, y0, y1");
        camera.screenMin = {window[0], window[2]};
        camera.screenMax = {window[1], window[3]};
        if (window[0] == window[1] || window[2] == window[3])
            throw badInput(where, "'screenwindow' is empty");
    }
}

int readSampler(const std::string& kind, ParameterList& parameters) {
    checkKind("sampler", kind, kSamplers, parameters);
    parameters.ignore({"seed", "randomization", "jitter", "dimensions"});
    int samples = 16;
    if (kind == "stratified")
        samples = parameters.integer("xsamples", 4, 1, 1024) * parameters.integer("ysamples", 4, 1, 1024);
    else
        samples = parameters.integer("pixelsamples", 16, 1, kMaxPixelSamples);
    parameters.finish();
    return samples;
}

int readIntegrator(const std::string& kind, ParameterList& parameters) {
    checkKind("integrator", kind, kIntegrators, parameters);
    const int maxDepth = parameters.integer("maxdepth", 5, 0, kMaxPathDepth);
    parameters.ignore({"lightsampler"});
    if (parameters.flag("regularize", false))
        throw badInput(parameters.positionOf("regularize"), "'regularize' is not supported");
    parameters.finish();
    return maxDepth;
}

} // namespace

void OptionBlock::set(const std::string& directive, const std::string& kind, ParameterList parameters) {
    entities_.insert_or_assign(directive, Entity{kind, std::move(parameters)});
}

OptionBlock::Entity& OptionBlock::entity(const std::string& directive, const std::string& defaultKind) {
    const auto entry = entities_.try_emplace(
        directive,
        Entity{defaultKind, ParameterList({}, fmt::format("{} \"{}\"", directive, defaultKind), {})});
    return entry.first->second;
}

void OptionBlock::resolve(Scene& scene, const SceneFiles& files, Monitor& monitor) {
    Entity& camera = entity("Camera", "perspective");
    Entity& film = entity("Film", "rgb");
    Entity& filter = entity("PixelFilter", "gaussian");
    Entity& sampler = entity("Sampler", "zsobol");
    Entity& integrator = entity("Integrator", "volpath");
    scene.camera = readShutter(camera.kind, camera.parameters);
    scene.camera.worldFromCamera = overShutter(
        worldFromCamera_, cameraTimes_, double(scene.camera.shutterOpen), double(scene.camera.shutterClose));
    scene.film =
        readFilm(film.kind, film.parameters, scene.camera.shutterClose - scene.camera.shutterOpen, monitor);
    if (camera.kind == "realistic") {
        const std::optional<std::string> lens = camera.parameters.text("lensfile");
        if (!lens)
            throw badInput(camera.parameters.position(), "Camera \"realistic\" needs \"string lensfile\"");
        scene.realistic = readRealistic(camera.parameters, files, files.resolve(*lens), monitor);
        scene.files.push_back(scene.realistic->lens.path);
    } else if (camera.kind == "spherical") {
        readSpherical(scene.camera, camera.parameters);
    } else {
        if (camera.kind == "orthographic") scene.camera.projection = Projection::parallel;
        readPerspective(scene.camera, camera.parameters, files);
        readScreen(scene.camera, camera.parameters, scene.film);
    }
    camera.parameters.finish();
    scene.filter = readFilter(filter.kind, filter.parameters);
    scene.pixelSamples = readSampler(sampler.kind, sampler.parameters);
    scene.maxDepth = readIntegrator(integrator.kind, integrator.parameters);
}

} // namespace slant

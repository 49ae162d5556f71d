#include "scene/option_block.h"

#include "base/suggest.h"
#include "scene/lens_file.h"
#include "scene/scene_files.h"
#include "scene/spectra.h"
#include "scene/spelling.h"
#include "scene/transforms.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

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
/// pbrt's, of all versions; what is not of path tracing becomes it.
constexpr std::string_view kIntegrators[] = {"path",
                                             "volpath",
                                             "ambientocclusion",
                                             "bdpt",
                                             "function",
                                             "lightpath",
                                             "mlt",
                                             "randomwalk",
                                             "simplepath",
                                             "sppm",
                                             "whitted",
                                             "simplevolpath",
                                             "ao",
                                             "directlighting",
                                             "photonmap",
                                             "igi",
                                             "exphotonmap",
                                             "irradiancecache",
                                             "useprobes",
                                             "diffuseprt",
                                             "glossyprt",
                                             "dipolesubsurface"};
constexpr std::string_view kFilms[] = {"rgb", "gbuffer", "spectral"};
constexpr std::string_view kSensors[] = {
    "cie1931",       "canon_eos_100d",     "canon_eos_1dx_mkii", "canon_eos_200d",    "canon_eos_200d_mkii",
    "canon_eos_5d",  "canon_eos_5d_mkii",  "canon_eos_5d_mkiii", "canon_eos_5d_mkiv", "canon_eos_5ds",
    "canon_eos_m",   "hasselblad_l1d_20c", "nikon_d810",         "nikon_d850",        "sony_ilce_6400",
    "sony_ilce_7m3", "sony_ilce_7rm3",     "sony_ilce_9"};
/// Of a shutter that opens for an instant, relative to the time, at least 1 s.
constexpr float kInstant = 1e-5f;

/// Throws unless `kind` is one of `kinds`.
void checkKind(std::string_view family, const std::string& kind, std::span<const std::string_view> kinds,
               const ParameterList& parameters) {
    if (std::find(kinds.begin(), kinds.end(), kind) == kinds.end())
        throw unsupported(parameters.position(), "{} \"{}\" is not supported{}", family, printable(kind),
                          didYouMean(kind, kinds));
}

Rect pixelBounds(const Film& film, ParameterList& parameters, Issues& issues) {
    const Rect whole{0, 0, film.xResolution, film.yResolution};
    const std::vector<int> bounds = parameters.integers("pixelbounds");
    if (bounds.empty()) return whole;
    const Position where = parameters.positionOf("pixelbounds");
    if (bounds.size() != 4) throw badInput(where, "'pixelbounds' needs four numbers: x0, x1, y0, y1");
    const Rect asked{bounds[0], bounds[2], bounds[1], bounds[3]};
    if (asked.intersect(whole) != asked)
        issues.note(where, "'pixelbounds' reach beyond the film and are clipped to it");
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

/// A measured sensor sees as the eye does, but for its white balance.
glm::mat3 readSensor(ParameterList& parameters, Issues& issues) {
    const std::string sensor = parameters.text("sensor").value_or(std::string(kSensors[0]));
    const Position where = parameters.positionOf("sensor");
    if (std::find(std::begin(kSensors), std::end(kSensors), sensor) == std::end(kSensors))
        throw badInput(where, "unknown sensor \"{}\"{}", printable(sensor), didYouMean(sensor, kSensors));
    float kelvin = parameters.number("whitebalance", 0, {0, 25000});
    if (sensor != kSensors[0]) {
        issues.note(where,
                    fmt::format("sensor \"{}\" is read as \"cie1931\" with its white balance", sensor));
        if (kelvin == 0) kelvin = 6500;
    }
    if (kelvin == 0) return glm::mat3(1);
    if (kelvin < 500)
        throw badInput(parameters.positionOf("whitebalance"),
                       "'whitebalance' is {}, but must be 0 or at least 500", kelvin);
    return whiteBalance(illuminantWhite(double(kelvin)));
}

Film readFilm(const std::string& kind, ParameterList& parameters, float exposureTime, Issues& issues) {
    checkKind("film", kind, kFilms, parameters);
    if (kind != "rgb")
        issues.note(parameters.position(), fmt::format("film \"{}\" is read as \"rgb\"", kind));
    Film film;
    film.xResolution = parameters.integer("xresolution", 1280, 1, kMaxResolution);
    film.yResolution = parameters.integer("yresolution", 720, 1, kMaxResolution);
    if (std::int64_t(film.xResolution) * film.yResolution > kMaxPixels)
        throw badInput(parameters.position(), "{}x{} pixels are more than the limit of {}", film.xResolution,
                       film.yResolution, kMaxPixels);
    film.crop = pixelBounds(film, parameters, issues);
    if (const std::vector<float> window = parameters.numbers("cropwindow"); !window.empty())
        film.crop = cropped(film, window, parameters.positionOf("cropwindow"));
    if (film.crop.empty()) throw badInput(parameters.position(), "the crop leaves no pixel of the film");
    film.filename = parameters.text("filename").value_or(film.filename);
    film.whiteBalance = readSensor(parameters, issues);
    film.imagingRatio = exposureTime * parameters.number("iso", 100, kPositive) / 100;
    film.maxComponentValue = parameters.number("maxcomponentvalue", kPositive).value_or(0);
    film.diagonalMm = parameters.number("diagonal", 35, kPositive);
    parameters.ignore({"savefp16", "coordinatesystem", "nbuckets", "lambdamin", "lambdamax"});
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

/// `exposureTime` in seconds.
PerspectiveCamera readShutter(const std::string& kind, ParameterList& parameters, float& exposureTime,
                              Issues& issues) {
    checkKind("camera", kind, kCameras, parameters);
    PerspectiveCamera camera;
    camera.shutterOpen = parameters.number("shutteropen", 0);
    camera.shutterClose = parameters.number("shutterclose", 1);
    exposureTime = camera.shutterClose - camera.shutterOpen;
    if (exposureTime < 0)
        throw badInput(parameters.position(),
                       "the shutter closes before it opens: 'shutterclose' must be after "
                       "'shutteropen'");
    if (exposureTime == 0) {
        issues.note(parameters.position(),
                    "the shutter is never open; the picture is that of the instant, exposed for 1 s");
        exposureTime = 1;
        camera.shutterClose += kInstant * std::max(1.f, std::abs(camera.shutterOpen));
    }
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
                              Issues& issues) {
    RealisticCamera camera;
    camera.lens = readLens(path, parameters.positionOf("lensfile"));
    camera.aperture = readShape(parameters, files);
    camera.apertureDiameterMm = parameters.number("aperturediameter", 1, kPositive);
    camera.focusLocation = parameters.positionOf("focusdistance");
    camera.focusDistance = parameters.number("focusdistance", 10, kPositive);
    if (const std::optional<float> distance = parameters.number("filmdistance", kPositive)) {
        camera.filmDistanceMm = double(*distance);
        camera.focusLocation = parameters.positionOf("filmdistance");
    }
    if (const double widest = camera.lens.surfaces[camera.lens.stop].diameter;
        camera.apertureDiameterMm > widest) {
        if (camera.apertureDiameterMm > double(float(widest)))
            issues.note(parameters.positionOf("aperturediameter"),
                        fmt::format("'aperturediameter' is {} mm, but the stop of {} opens to {} mm only",
                                    camera.apertureDiameterMm, path, widest));
        camera.apertureDiameterMm = widest;
    }
    return camera;
}

/// Cameras of pbrt-v2 that are given the distance of their film have millimetres as units, and the front of
/// their lens at the origin.
void placeByFront(const RealisticCamera& camera, MovingTransform& worldFromCamera) {
    double length = *camera.filmDistanceMm;
    for (std::size_t i = 0; i + 1 < camera.lens.surfaces.size(); ++i)
        length += camera.lens.surfaces[i].thickness;
    const glm::dmat4 frontFromFilm =
        glm::scale(glm::translate(glm::dmat4(1), {0, 0, -length}), glm::dvec3(1000));
    for (glm::dmat4& matrix : worldFromCamera.at) matrix = matrix * frontFromFilm;
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

int readIntegrator(const std::string& kind, ParameterList& parameters, Issues& issues) {
    checkKind("integrator", kind, kIntegrators, parameters);
    const int maxDepth = parameters.integer("maxdepth", 5, 0, kMaxPathDepth);
    if (kind != "path" && kind != "volpath") {
        issues.note(parameters.position(), fmt::format("integrator \"{}\" is read as \"path\"", kind));
        parameters.ignoreRest();
    }
    parameters.ignore({"lightsampler"});
    if (parameters.flag("regularize", false))
        issues.note(parameters.positionOf("regularize"), "'regularize' is ignored: nothing is blurred");
    parameters.finish();
    return maxDepth;
}

} // namespace

void OptionBlock::set(const std::string& directive, const std::string& kind, ParameterList parameters) {
    entities_.insert_or_assign(directive, Entity{kind, std::move(parameters)});
}

OptionBlock::Entity& OptionBlock::entity(const std::string& directive, const std::string& defaultKind) {
    const auto entry = entities_.try_emplace(
        directive, Entity{defaultKind,
                          ParameterList({}, fmt::format("{} \"{}\"", directive, defaultKind), {}, issues_)});
    return entry.first->second;
}

void OptionBlock::resolveCamera(Scene& scene, Entity& camera, const SceneFiles& files) {
    if (camera.kind == "realistic") {
        const std::optional<std::string> lens = camera.parameters.text("lensfile");
        if (!lens)
            throw badInput(camera.parameters.position(), "Camera \"realistic\" needs \"string lensfile\"");
        scene.realistic = readRealistic(camera.parameters, files, files.resolve(*lens), issues_);
        scene.files.push_back(scene.realistic->lens.path);
        if (scene.realistic->filmDistanceMm) {
            scene.film.diagonalMm = camera.parameters.number("filmdiag", scene.film.diagonalMm, kPositive);
            placeByFront(*scene.realistic, scene.camera.worldFromCamera);
        }
    } else if (camera.kind == "spherical") {
        readSpherical(scene.camera, camera.parameters);
    } else {
        if (camera.kind == "orthographic") scene.camera.projection = Projection::parallel;
        readPerspective(scene.camera, camera.parameters, files);
        readScreen(scene.camera, camera.parameters, scene.film);
    }
    camera.parameters.finish();
}

void OptionBlock::resolve(Scene& scene, const SceneFiles& files) {
    Entity& camera = entity("Camera", "perspective");
    Entity& film = entity("Film", "rgb");
    Entity& filter = entity("PixelFilter", "gaussian");
    Entity& sampler = entity("Sampler", "zsobol");
    Entity& integrator = entity("Integrator", "volpath");
    float exposureTime = 1;
    const bool hasShutter = issues_.attempt(
        "", [&] { scene.camera = readShutter(camera.kind, camera.parameters, exposureTime, issues_); });
    scene.camera.worldFromCamera = overShutter(
        worldFromCamera_, cameraTimes_, double(scene.camera.shutterOpen), double(scene.camera.shutterClose));
    issues_.attempt("the film is \"rgb\" of 1280x720",
                    [&] { scene.film = readFilm(film.kind, film.parameters, exposureTime, issues_); });
    if (hasShutter) issues_.attempt("", [&] { resolveCamera(scene, camera, files); });
    issues_.attempt("the filter is \"gaussian\"",
                    [&] { scene.filter = readFilter(filter.kind, filter.parameters); });
    issues_.attempt("16 samples are taken of a pixel",
                    [&] { scene.pixelSamples = readSampler(sampler.kind, sampler.parameters); });
    issues_.attempt("the integrator is \"path\"", [&] {
        scene.maxDepth = readIntegrator(integrator.kind, integrator.parameters, issues_);
    });
}

} // namespace slant

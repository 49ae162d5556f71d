// slant lens: describes a lens, and how elaborate a slope model its light fields need.
#include "base/atomic_file.h"
#include "base/error.h"
#include "camera/lens_drawing.h"
#include "camera/slope_residual.h"
#include "commands/commands.h"
#include "commands/options.h"
#include "commands/picture_job.h"
#include "commands/terminal_monitor.h"
#include "scene/lens_file.h"
#include "scene/read_scene.h"
#include "trace/tracer.h"

#include <filesystem>
#include <limits>
#include <memory>
#include <numbers>

namespace slant::commands {
namespace {

// Defaults.
constexpr double kFNumber = 2.8;
constexpr double kFocusInFocalLengths = 20, kFocusInNearest = 1.2;
constexpr double kFullFrameMm = 43.27; ///< diagonal
constexpr double kImageCircleShare = 0.9;

struct LensOptions {
    std::string file, svg;
    ReadOptions reading;
    std::optional<double> apertureMm, focusDistance, diagonalMm;
    double tolerancePx = kSlopeTolerancePx;
};

/// What is shown: a camera, the film it exposes and the depths before it.
struct Subject {
    CompoundLens camera;
    Film film;
    std::string path;
    double nearDepth, farDepth; ///< metres
};

Film filmOf(double diagonalMm) {
    Film film;
    film.xResolution = 480;
    film.yResolution = 270;
    film.diagonalMm = float(diagonalMm);
    return film;
}

Subject fromScene(const LensOptions& options) {
    if (options.apertureMm || options.focusDistance || options.diagonalMm)
        throw Error(ErrorCode::usage,
                    "--aperture, --focus-distance and --diagonal are for lens files; a scene "
                    "has its own");
    TerminalMonitor monitor(TerminalMonitor::styleOfStderr(true));
    Scene scene = readScene(options.file, monitor, options.reading);
    if (!scene.realistic)
        throw badInput({options.file}, "the camera of this scene is not \"realistic\": it has no lens");
    scene.realistic->aperture = {}; // figures and drawing are for the round stop
    const Tracer tracer(scene, monitor);
    const CompoundLens& camera = *tracer.camera().compoundLens();
    const auto [nearest, farthest] = tracer.depthRange();
    return {camera, scene.film, scene.realistic->lens.path,
            std::isfinite(nearest) ? nearest : camera.focusDepth() / 2, farthest};
}

Subject fromLensFile(const LensOptions& options) {
    RealisticCamera camera;
    camera.lens = readLens(options.file, {});
    const double widest = camera.lens.surfaces[camera.lens.stop].diameter;
    const LensSystem open(camera.lens, widest);
    camera.apertureDiameterMm =
        std::min(widest, options.apertureMm.value_or(widest * open.fNumber() / kFNumber));
    camera.focusDistance = options.focusDistance.value_or(
        std::max(kFocusInFocalLengths * open.focalLength(), kFocusInNearest * open.nearestFocus()) / 1000);
    camera.focusLocation = {options.file};
    Film film = filmOf(options.diagonalMm.value_or(kFullFrameMm));
    if (!options.diagonalMm) {
        const double circle = 2 * CompoundLens(camera, {}, film).pupil().imageRadius();
        film = filmOf(std::min(kFullFrameMm, kImageCircleShare * circle));
    }
    CompoundLens lens(camera, {}, film);
    const double nearDepth = lens.focusDepth() / 2;
    return {std::move(lens), film, options.file, nearDepth, std::numeric_limits<double>::infinity()};
}

bool isScene(const std::string& file) {
    return std::filesystem::path(file).filename().string().find(".pbrt") != std::string::npos;
}

/// Angle between the axis and what the film sees in its corner, through the middle of the pupil.
double halfField(const CompoundLens& camera) {
    const glm::dvec2 corner = camera.filmCentre();
    const glm::dvec2 lens = camera.pupil().at(glm::length(corner) * camera.millimetresPerPixel(), {0, 0}) /
                            camera.pupil().radius();
    const auto path = camera.path(2.0 * corner, lens.x * glm::normalize(corner));
    if (!path) return std::numeric_limits<double>::quiet_NaN();
    return std::atan(glm::length(path->line.tangent)) * 180 / std::numbers::pi;
}

void printFigures(const Subject& subject) {
    const CompoundLens& camera = subject.camera;
    const LensSystem& lens = camera.lens();
    const double half = glm::length(camera.filmCentre()) * camera.millimetresPerPixel();
    fmt::print("{}\n", subject.path);
    fmt::print("  focal length    {:.3f} mm, nearest focus {:.3f} m\n", lens.focalLength(),
               lens.nearestFocus() / 1000);
    fmt::print("  f-number        {:.2f}\n", lens.fNumber());
    fmt::print("  focus           {:.4g} m from the film, {:.4g} m from the entrance pupil\n",
               camera.focusDepth() + (camera.depthOrigin() - camera.filmZ()) / 1000, camera.focusDepth());
    fmt::print("  film            {:.2f} mm behind the rear surface, {:.2f} mm across, {}x{} pixels\n",
               -camera.filmZ(), 2 * half, subject.film.xResolution, subject.film.yResolution);
    fmt::print("  entrance pupil  {:.2f} mm wide, {:.2f} mm behind the front\n",
               2 * lens.entrancePupil().radius, lens.frontVertex() - lens.entrancePupil().z);
    fmt::print("  exit pupil      {:.2f} mm wide, {:.2f} mm before the film\n", 2 * lens.exitPupil().radius,
               lens.exitPupil().z - camera.filmZ());
    const double field = halfField(camera);
    if (std::isnan(field))
        fmt::print("  field           the corners are dark: the image circle is {:.2f} mm wide\n",
                   2 * camera.pupil().imageRadius());
    else
        fmt::print("  field           {:.1f} degrees across the diagonal, corners {:.0f} % as bright as the "
                   "centre\n",
                   2 * field, 100 * camera.pupil().irradiance(half) / camera.pupil().irradiance(0));
}

void printResiduals(const Subject& subject, double tolerancePx) {
    const CompoundLens& camera = subject.camera;
    const std::vector<DepthResiduals> residuals = slopeResiduals(camera, subject.nearDepth, subject.farDepth);
    fmt::print("\n  Slope models: pixels off, 95th percentile / maximum\n  {:<38}", "");
    for (const DepthResiduals& at : residuals) fmt::print("{:>18}", fmt::format("{:.4g} m", at.depth));
    fmt::print("\n  {:<38}", "largest slope");
    for (const DepthResiduals& at : residuals) fmt::print("{:>18.2f}", at.blurPx);
    const std::pair<const char*, Residual DepthResiduals::*> rows[] = {
        {"lens: two constants", &DepthResiduals::lens},
        {"film radius: mean slope", &DepthResiduals::radiusMean},
        {"film radius: radial and tangential", &DepthResiduals::radius},
        {"the same, aberrations in focus aside", &DepthResiduals::corrected},
        {"sample: mean slope", &DepthResiduals::sampleMean},
        {"sample: 2 x 2", &DepthResiduals::sample},
        {"on the scene's side: two constants", &DepthResiduals::scene},
    };
    for (const auto& [name, member] : rows) {
        fmt::print("\n  {:<38}", name);
        for (const DepthResiduals& at : residuals)
            fmt::print("{:>18}",
                       fmt::format("{:.2f} / {:.2f}", (at.*member).percentile95, (at.*member).maximum));
    }
    const SlopeFitKind fit = selectSlopeFit(residuals, tolerancePx);
    constexpr std::array kNames{"lens", "film radius", "sample"};
    fmt::print("\n  A tolerance of {:g} px selects: {}{}\n", tolerancePx, kNames[std::size_t(fit)],
               worstResidual(residuals, fit) > tolerancePx ? ", the best, though none is within it" : "");
}

void runLens(const LensOptions& options) {
    if (!options.svg.empty()) checkWritable(options.svg);
    const Subject subject = isScene(options.file) ? fromScene(options) : fromLensFile(options);
    printFigures(subject);
    printResiduals(subject, options.tolerancePx);
    if (options.svg.empty()) return;
    AtomicFile file(options.svg);
    file.write(drawLens(subject.camera, subject.film.xResolution * subject.camera.millimetresPerPixel()));
    file.commit();
}

} // namespace

void addLens(CLI::App& program) {
    CLI::App* command =
        program.add_subcommand("lens", "Describe a lens and how well slope models fit its light fields");
    const auto options = std::make_shared<LensOptions>();
    command->add_option("FILE", options->file, "lens file, or scene with a \"realistic\" camera")
        ->required()
        ->type_name("");
    addLenientOption(*command, options->reading);
    addNumber<double>(*command, "--aperture", options->apertureMm, 1e-3, 1e6,
                      "diameter of the stop in mm (default: f/2.8, or the widest)");
    addNumber<double>(*command, "--focus-distance", options->focusDistance, 1e-3, 1e9,
                      "distance from the film in m (default: 20 focal lengths)");
    addNumber<double>(*command, "--diagonal", options->diagonalMm, 1e-3, 1e6,
                      "diagonal of the film in mm (default: 43.27, or what fits the image circle)");
    addNumber<double>(*command, "--tolerance", options->tolerancePx, 0, 1e6,
                      "pixels that a slope model may be off (default 0.25)");
    command->add_option("--svg", options->svg, "draw the lens with rays")->type_name("FILE.svg");
    command->callback([options] { runLens(*options); });
}

} // namespace slant::commands

#include "commands/focus_options.h"

#include "base/error.h"
#include "commands/options.h"

#include <filesystem>

namespace slant::commands {
namespace {

constexpr double kLargestDistance = 1e12, kSmallestDistance = 1e-12;
constexpr int kMaxFrames = 9999;

} // namespace

void addFocusOptions(CLI::App& command, FocusOptions& options) {
    const auto distance = [&](const char* name, std::optional<double>& target, const char* help) {
        return addNumber<double>(command, name, target, kSmallestDistance, kLargestDistance, help)
            ->type_name("D");
    };
    CLI::Option* const single =
        distance("--focus-distance", options.distance, "focus at this distance instead");
    CLI::Option* const from = distance("--focus-from", options.from, "first focus of a pull");
    CLI::Option* const to = distance("--focus-to", options.to, "last focus of a pull");
    CLI::Option* const frames = addNumber<int>(command, "--frames", options.frames, 2, kMaxFrames,
                                               "pictures of a pull, FILE-0001.exr and so on");
    single->excludes(from)->excludes(to)->excludes(frames);
    from->needs(to)->needs(frames);
    to->needs(from)->needs(frames);
    frames->needs(from)->needs(to);

    CLI::Option* const scale = addNumber<float>(command, "--aperture-scale", options.apertureScale, 0, 100,
                                                "lens radius relative to the traced one")
                                   ->type_name("A");
    CLI::Option* const stop = addNumber<float>(command, "--f-stop", options.fStop, 1e-3f, 1e6f,
                                               "f-number, if the field gives its focal length")
                                  ->type_name("N");
    CLI::Option* const pinhole = command.add_flag_callback(
        "--pinhole", [&options] { options.apertureScale = 0.f; }, "no blur: the view from the lens's centre");
    command
        .add_option("--aperture", options.aperture,
                    "its shape: disc, gaussian, square, pentagon, star, \"polygon BLADES [DEGREES]\", or an "
                    "image file (default: as traced)")
        ->type_name("SHAPE");
    scale->excludes(stop)->excludes(pinhole);
    stop->excludes(pinhole);
}

void checkFocusOptions(const FocusOptions& options, Method method) {
    ReconstructOptions reconstruction;
    reconstruction.method = method;
    reconstruction.anyFocus = true;
    LensView view; // any other than traced
    if (options.refocuses()) view.slopeShift = 1;
    if (options.apertureScale || options.fStop || !options.aperture.empty()) view.apertureScale = 0;
    checkView(reconstruction, view);
}

float apertureScale(const FocusOptions& options, const FieldMetadata& details) {
    if (!options.fStop) return options.apertureScale.value_or(1.f);
    if (!(details.focalLength > 0) || !(details.lensRadius > 0))
        throw Error(ErrorCode::usage,
                    "--f-stop needs a field that gives its focal length and lens radius "
                    "(slant:focalLength, slant:lensRadius), and a perspective camera has no "
                    "focal length; use --aperture-scale");
    return details.focalLength / (2 * *options.fStop * details.lensRadius);
}

std::vector<std::optional<double>> focusDistances(const FocusOptions& options) {
    if (options.frames == 0) return {options.distance};
    std::vector<std::optional<double>> distances;
    const double first = 1 / *options.from, last = 1 / *options.to;
    for (int i = 0; i < options.frames; ++i) {
        const double part = double(i) / (options.frames - 1);
        distances.emplace_back(i == 0                    ? *options.from
                               : i == options.frames - 1 ? *options.to
                                                         : 1 / (first + (last - first) * part));
    }
    return distances;
}

std::string numbered(const std::string& path, std::size_t number) {
    if (path.empty()) return path;
    std::filesystem::path name(path);
    const std::string stem = name.stem().string(), extension = name.extension().string();
    return name.replace_filename(fmt::format("{}-{:04}{}", stem, number, extension)).string();
}

} // namespace slant::commands

#include "commands/view_options.h"

#include "base/error.h"
#include "commands/options.h"

#include <algorithm>
#include <filesystem>

namespace slant::commands {
namespace {

constexpr double kLargestDistance = 1e12, kSmallestDistance = 1e-12;
constexpr int kMaxFrames = 9999;

/// "0.25,0.75"
Shutter parseShutter(const std::string& text) {
    const std::size_t comma = std::min(text.find(','), text.size());
    const auto open = parseNumber<float>(std::string_view(text).substr(0, comma));
    const auto close = parseNumber<float>(std::string_view(text).substr(std::min(comma + 1, text.size())));
    if (!open || !close || !(0 <= *open && *open < *close && *close <= 1))
        throw CLI::ValidationError("--shutter", fmt::format("'{}' is not A,B with 0 <= A < B <= 1", text));
    return {*open, *close};
}

void addFocusOptions(CLI::App& command, ViewOptions& options) {
    const auto distance = [&](const char* name, std::optional<double>& target, const char* help) {
        return addNumber<double>(command, name, target, kSmallestDistance, kLargestDistance, help)
            ->type_name("D");
    };
    CLI::Option* const single =
        distance("--focus-distance", options.distance, "focus at this distance instead");
    CLI::Option* const from = distance("--focus-from", options.focusFrom, "first focus of a pull");
    CLI::Option* const to = distance("--focus-to", options.focusTo, "last focus of a pull");
    single->excludes(from)->excludes(to);
    from->needs(to);
    to->needs(from);
}

void addTimeOptions(CLI::App& command, ViewOptions& options) {
    CLI::Option* const shutter =
        command
            .add_option_function<std::string>(
                "--shutter", [&options](const std::string& text) { options.shutter = parseShutter(text); },
                "open from A to B instead, of the traced shutter's 0 to 1")
            ->type_name("A,B");
    const auto time = [&](const char* name, std::optional<double>& target, const char* help) {
        return addNumber<double>(command, name, target, 0, 1, help)->type_name("T");
    };
    CLI::Option* const freeze = time("--freeze", options.freeze, "show one instant, from 0 to 1");
    CLI::Option* const from = time("--freeze-from", options.freezeFrom, "first instant of slow motion");
    CLI::Option* const to = time("--freeze-to", options.freezeTo, "last instant of slow motion");
    shutter->excludes(freeze)->excludes(from)->excludes(to);
    freeze->excludes(from)->excludes(to);
    from->needs(to);
    to->needs(from);
}

void addLensOptions(CLI::App& command, ViewOptions& options) {
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

Shutter instant(double time) {
    return {float(time), float(time)};
}

/// `part` of the way, with both ends as they are.
double between(double first, double last, double part) {
    return part == 0 ? first : part == 1 ? last : first + (last - first) * part;
}

} // namespace

void addViewOptions(CLI::App& command, ViewOptions& options) {
    addFocusOptions(command, options);
    addTimeOptions(command, options);
    addNumber<int>(command, "--frames", options.frames, 2, kMaxFrames,
                   "pictures of a pull or of slow motion, FILE-0001.exr and so on");
    addLensOptions(command, options);
}

void checkViewOptions(const ViewOptions& options, Method method) {
    const bool sequence = options.focusFrom || options.freezeFrom;
    if (sequence && options.frames == 0)
        throw Error(ErrorCode::usage,
                    fmt::format("{} needs --frames", options.focusFrom ? "--focus-from" : "--freeze-from"));
    if (!sequence && options.frames > 0)
        throw Error(ErrorCode::usage, "--frames needs --focus-from or --freeze-from");
    ReconstructOptions reconstruction;
    reconstruction.method = method;
    reconstruction.anyFocus = true;
    LensView view; // any other than traced
    if (options.refocuses()) view.slopeShift = 1;
    if (options.apertureScale || options.fStop || !options.aperture.empty()) view.apertureScale = 0;
    if (options.changesTime()) view.shutterClose = 0;
    checkView(reconstruction, view);
}

float apertureScale(const ViewOptions& options, const FieldMetadata& details) {
    if (!options.fStop) return options.apertureScale.value_or(1.f);
    if (!(details.focalLength > 0) || !(details.lensRadius > 0))
        throw Error(ErrorCode::usage,
                    "--f-stop needs a field that gives its focal length and lens radius "
                    "(slant:focalLength, slant:lensRadius), and a perspective camera has no "
                    "focal length; use --aperture-scale");
    return details.focalLength / (2 * *options.fStop * details.lensRadius);
}

std::vector<ViewStep> viewSteps(const ViewOptions& options) {
    std::vector<ViewStep> steps(std::size_t(std::max(options.frames, 1)),
                                {options.distance, options.shutter});
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const double part = i == 0 ? 0 : double(i) / double(steps.size() - 1);
        if (options.focusFrom)
            steps[i].focusDistance = part == 0 ? *options.focusFrom
                                     : part == 1
                                         ? *options.focusTo
                                         : 1 / between(1 / *options.focusFrom, 1 / *options.focusTo, part);
        if (options.freeze) steps[i].shutter = instant(*options.freeze);
        if (options.freezeFrom)
            steps[i].shutter = instant(between(*options.freezeFrom, *options.freezeTo, part));
    }
    return steps;
}

std::string numbered(const std::string& path, std::size_t number) {
    if (path.empty()) return path;
    std::filesystem::path name(path);
    const std::string stem = name.stem().string(), extension = name.extension().string();
    return name.replace_filename(fmt::format("{}-{:04}{}", stem, number, extension)).string();
}

} // namespace slant::commands

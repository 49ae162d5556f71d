#include "commands/options.h"

#include "base/error.h"
#include "base/suggest.h"
#include "reconstruct/output_pattern.h"

#include <array>
#include <limits>

namespace slant::commands {
namespace {

constexpr int kMaxCoordinate = 1 << 20;

} // namespace

std::optional<std::uint64_t> parseSize(std::string_view text) {
    constexpr std::string_view kSuffixes = "KMGT";
    int shift = 0;
    if (!text.empty()) {
        const std::size_t suffix = kSuffixes.find(text.back());
        if (suffix != std::string_view::npos) {
            shift = 10 * (int(suffix) + 1);
            text.remove_suffix(1);
        }
    }
    const auto count = parseNumber<std::uint64_t>(text);
    if (!count || *count > std::numeric_limits<std::uint64_t>::max() >> shift) return {};
    return *count << shift;
}

std::optional<Rect> parseCrop(std::string_view text) {
    std::array<int, 4> bounds{};
    for (std::size_t i = 0; i < bounds.size(); ++i) {
        const std::size_t comma = text.find(',');
        if ((comma == std::string_view::npos) != (i == 3)) return {};
        const auto number = parseNumber<int>(text.substr(0, comma));
        if (!number || *number < -kMaxCoordinate || *number > kMaxCoordinate) return {};
        bounds[i] = *number;
        if (i < 3) text.remove_prefix(comma + 1);
    }
    const Rect crop{bounds[0], bounds[2], bounds[1], bounds[3]};
    if (crop.empty()) return {};
    return crop;
}

void addSeedOption(CLI::App& command, CommonOptions& options) {
    addNumber<std::uint64_t>(command, "--seed", options.seed, 0, std::numeric_limits<std::uint64_t>::max(),
                             "seed of the sampling pattern (default 0)");
}

void addSlopesOption(CLI::App& command, CommonOptions& options) {
    const auto slopes = [&options](const std::string& text) {
        if (text != "optics" && text != "surface")
            throw CLI::ValidationError("--slopes", fmt::format("'{}' is neither optics nor surface", text));
        options.slopes = text == "optics" ? SlopeSource::optics : SlopeSource::surface;
    };
    command
        .add_option_function<std::string>("--slopes", slopes,
                                          "how what is seen in mirrors and glass moves over the lens: optics "
                                          "(default), or as their surface does: surface")
        ->type_name("NAME");
}

void addSamplingOptions(CLI::App& command, CommonOptions& options) {
    addNumber<int>(command, "--spp", options.spp, 1, kMaxSamplesPerPixel,
                   "samples per pixel (default: the scene's pixelsamples)");
    addSeedOption(command, options);
    const auto crop = [&options](const std::string& text) {
        options.crop = parseCrop(text);
        if (!options.crop)
            throw CLI::ValidationError("--crop", fmt::format("'{}' is not x0,x1,y0,y1 in pixels with x0 < x1 "
                                                             "and y0 < y1",
                                                             text));
    };
    command.add_option_function<std::string>("--crop", crop, "pixels to render (default: the scene's)")
        ->type_name("x0,x1,y0,y1");
}

namespace {

void addWindowOptions(CLI::App& command, CommonOptions& options) {
    constexpr int kMaxRangePx = 128;
    WindowOptions& window = options.window;
    const auto noted = [&options](CLI::Option* option) {
        option->each(
            [&options, name = option->get_name()](const std::string&) { options.windowOption = name; });
    };
    noted(addNumber<int>(command, "--window-range", window.rangePx, 0, kMaxRangePx,
                         "for window: pixels to each side (default 4)"));
    noted(addNumber<float>(command, "--window-alpha", window.alpha, 0, 1e6f,
                           "for window: alpha of the Gaussian, per square pixel (default 100)"));
    noted(addNumber<float>(command, "--window-delta", window.lensStep, 0, 2,
                           "for window: lens radii within which no trajectories of a surface cross (default "
                           "1/sqrt(spp))"));
    noted(command.add_flag(
        "--window-fill", window.fill,
        "for window: no black holes; where no sample is near, take the nearest of the window"));
}

} // namespace

void checkMethodOptions(const CommonOptions& options) {
    if (traitsOf(options.method).source != DenseSource::window && !options.windowOption.empty())
        throw Error(ErrorCode::usage, fmt::format("{} is for --method window, not {}", options.windowOption,
                                                  nameOf(options.method)));
    if (!traitsOf(options.method).usesLayerMap && options.debugLayerMap)
        throw Error(ErrorCode::usage, fmt::format("--debug-image layer-map is for --method auto, not {}",
                                                  nameOf(options.method)));
}

void addReconstructionOptions(CLI::App& command, CommonOptions& options) {
    const auto outSpp = [&options](const std::string& text) {
        const auto count = parseNumber<int>(text);
        if (!count || !isOutputCount(*count))
            throw CLI::ValidationError("--out-spp", fmt::format("'{}' is not a power of two from 1 to {}",
                                                                text, kMaxOutputsPerPixel));
        options.outSpp = *count;
    };
    command
        .add_option_function<std::string>("--out-spp", outSpp,
                                          "reconstructed samples per pixel (default 128)")
        ->type_name("N");
    const auto method = [&options](const std::string& text) {
        const std::optional<Method> parsed = parseMethod(text);
        if (!parsed)
            throw CLI::ValidationError("--method", fmt::format("'{}' is none of {}{}", text,
                                                               fmt::join(methodNames(), ", "),
                                                               didYouMean(text, methodNames())));
        options.method = *parsed;
    };
    command
        .add_option_function<std::string>(
            "--method", method,
            fmt::format("{} (default {})", fmt::join(methodNames(), " or "), nameOf(options.method)))
        ->type_name("NAME");
    addWindowOptions(command, options);
    const auto debugImage = [&options](const std::string& text) {
        if (text != "layer-map")
            throw CLI::ValidationError("--debug-image", fmt::format("'{}' is not layer-map", text));
        options.debugLayerMap = true;
    };
    command
        .add_option_function<std::string>("--debug-image", debugImage,
                                          "for auto: write OUTPUT.layer-map.png, white where outputs came "
                                          "from the layer map, black where not")
        ->type_name("layer-map");
    command
        .add_option("--device", options.device, "auto, cpu, or part of a Vulkan device's name (default auto)")
        ->type_name("NAME");
    const auto memory = [&options](const std::string& text) {
        const auto size = parseSize(text);
        if (!size || *size < std::uint64_t(16) << 20)
            throw CLI::ValidationError(
                "--memory", fmt::format("'{}' is not a size such as 512M or 2G, at least 16M", text));
        options.memoryBytes = *size;
    };
    command
        .add_option_function<std::string>("--memory", memory,
                                          "memory budget of the reconstruction (default 1G)")
        ->type_name("SIZE");
}

void addRunOptions(CLI::App& command, CommonOptions& options) {
    addNumber<int>(command, "--threads", options.threads, 0, 1024, "threads (default 0: one per core)");
    command.add_flag("--quiet", options.quiet, "no progress on stderr");
    command.add_option("--stats", options.statsPath, "write seconds, items and rates of each stage as JSON")
        ->type_name("FILE.json");
}

} // namespace slant::commands

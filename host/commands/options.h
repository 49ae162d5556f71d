// Options that several commands share, checked as they are parsed: whatever is out of range is a usage error.
#pragma once
#include "base/rect.h"
#include "reconstruct/options.h"
#include "trace/sample_options.h"

#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdint>
#include <fmt/format.h>
#include <optional>
#include <string>

namespace slant::commands {

inline constexpr int kMaxSamplesPerPixel = 1 << 16;

struct CommonOptions {
    // What to sample.
    std::optional<int> spp; ///< input samples per pixel; unset: what the scene asks for
    std::uint64_t seed = 0;
    std::optional<Rect> crop; ///< pixels; unset: what the scene asks for
    SlopeSource slopes = SlopeSource::optics;
    // How to reconstruct.
    int outSpp = 128; ///< output samples per pixel
    Method method = Method::automatic;
    WindowOptions window;
    std::string windowOption;                           ///< one of them that was given; empty: none
    std::string device = "auto";                        ///< auto, cpu, or part of a device's name
    std::uint64_t memoryBytes = std::uint64_t(1) << 30; ///< for dense samples and intermediate buffers
    bool debugLayerMap = false;                         ///< write a picture of where the layer map was used
    // How to run.
    int threads = 0; ///< 0 = all cores
    bool quiet = false;
    std::string statsPath; ///< empty: none
};

/// --seed
void addSeedOption(CLI::App& command, CommonOptions& options);
/// --spp, --seed, --crop
void addSamplingOptions(CLI::App& command, CommonOptions& options);
/// --slopes
void addSlopesOption(CLI::App& command, CommonOptions& options);
/// --out-spp, --method, --window-..., --device, --memory
void addReconstructionOptions(CLI::App& command, CommonOptions& options);
/// Throws Error(usage) for options of a method that was not chosen.
void checkMethodOptions(const CommonOptions& options);
/// --threads, --quiet, --stats
void addRunOptions(CLI::App& command, CommonOptions& options);

/// All of `text` as a finite number; nothing if it is not one. No plus sign, hexadecimal digits or spaces.
template <typename Number>
std::optional<Number> parseNumber(std::string_view text) {
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) return {};
    if (!(value - value == 0)) return {};
    return value;
}

/// Bytes of "4096", "64K", "512M" or "2G" (powers of 1024).
std::optional<std::uint64_t> parseSize(std::string_view text);

/// Pixels of "x0,x1,y0,y1", half-open; nothing if it is malformed or empty.
std::optional<Rect> parseCrop(std::string_view text);

/// An option with a number within [lowest, highest].
template <typename Number, typename Target>
CLI::Option* addNumber(CLI::App& command, const std::string& name, Target& value, Number lowest,
                       Number highest, const std::string& help) {
    const auto parse = [&value, name, lowest, highest](const std::string& text) {
        const std::optional<Number> number = parseNumber<Number>(text);
        if (!number || *number < lowest || *number > highest)
            throw CLI::ValidationError(
                name, fmt::format("'{}' is not a number from {} to {}", text, lowest, highest));
        value = *number;
    };
    return command.add_option_function<std::string>(name, parse, help)->type_name("N");
}

} // namespace slant::commands

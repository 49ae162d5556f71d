// slant diff: metrics of an image against its reference, and an exit status for scripts.
#include "base/atomic_file.h"
#include "base/error.h"
#include "commands/commands.h"
#include "commands/options.h"
#include "commands/terminal_monitor.h"
#include "image/exr.h"
#include "image/flip.h"
#include "image/heat_map.h"
#include "image/metrics.h"
#include "image/png.h"
#include "image/srgb.h"

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

namespace slant::commands {
namespace {

struct DiffOptions {
    std::string image, reference, heatMap;
    bool json = false;
    float exposure = 0; ///< stops, of FLIP
    std::optional<double> maxMse, maxRelMse, minPsnr, maxAbs, maxDrift, maxP99, maxFlip;
};

struct Figures {
    Metrics metrics;
    double flip; ///< mean
};

/// Channels beyond the colours that both images have, by their layer's name: N for N.X.
struct Layer {
    std::string name;
    std::vector<std::string> channels;
    Metrics metrics;
};

/// The parts of the images that are compared.
struct Parts {
    std::vector<std::string> colours;  ///< R, G, B if both images have them; else none, and all is one
    std::vector<Layer> layers;         ///< in the order of the image's channels
    std::vector<std::string> unpaired; ///< channels of one image only
};

bool isPng(const std::string& path) {
    const std::string extension = std::filesystem::path(path).extension().string();
    return extension == ".png" || extension == ".PNG";
}

/// Linear values; those of a PNG are decoded from sRGB (but not alpha).
Image readLinear(const std::string& path) {
    if (!isPng(path)) return readExr(path).image;
    Image image = readPng(path);
    const auto channels = std::size_t(image.channelCount());
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        if (image.channels[i % channels] != "A") image.pixels[i] = linearFromSrgb(image.pixels[i]);
    return image;
}

Parts partsOf(const Image& image, const Image& reference) {
    const auto isColour = [](const std::string& name) { return name == "R" || name == "G" || name == "B"; };
    const auto hasColours = [](const Image& in) {
        return in.channel("R") >= 0 && in.channel("G") >= 0 && in.channel("B") >= 0;
    };
    if (!hasColours(image) || !hasColours(reference)) return {};
    Parts parts{{"R", "G", "B"}, {}, {}};
    for (const std::string& channel : image.channels) {
        if (isColour(channel)) continue;
        if (reference.channel(channel) < 0) {
            parts.unpaired.push_back(channel);
            continue;
        }
        const std::string name = channel.substr(0, channel.rfind('.'));
        auto layer = std::ranges::find(parts.layers, name, &Layer::name);
        if (layer == parts.layers.end()) layer = parts.layers.insert(layer, {name, {}, {}});
        layer->channels.push_back(channel);
    }
    for (const std::string& channel : reference.channels)
        if (image.channel(channel) < 0) parts.unpaired.push_back(channel);
    return parts;
}

/// Which figures are out of bounds and by how much, one entry each; empty if all is well.
std::vector<std::string> violations(const Figures& figures, const Parts& parts, const DiffOptions& options) {
    const Metrics& m = figures.metrics;
    std::vector<std::string> list;
    if (m.nonFinite > 0) list.push_back(fmt::format("{} values are NaN or infinite", m.nonFinite));
    for (const Layer& layer : parts.layers)
        if (layer.metrics.nonFinite > 0)
            list.push_back(
                fmt::format("{} values of {} are NaN or infinite", layer.metrics.nonFinite, layer.name));
    const auto above = [&](const char* name, double value, const std::optional<double>& bound) {
        if (bound && !(value <= *bound))
            list.push_back(
                fmt::format("{} {:.4g} exceeds {:.4g} by {:.4g}", name, value, *bound, value - *bound));
    };
    above("MSE", m.mse, options.maxMse);
    above("relMSE", m.relMse, options.maxRelMse);
    above("maximum error", m.maxAbs, options.maxAbs);
    above("mean drift (either way)", std::abs(m.drift), options.maxDrift);
    above("99th percentile", m.p99, options.maxP99);
    above("FLIP", figures.flip, options.maxFlip);
    if (options.minPsnr && !(m.psnr >= *options.minPsnr))
        list.push_back(fmt::format("PSNR {:.4g} dB falls short of {:.4g} dB by {:.4g} dB", m.psnr,
                                   *options.minPsnr, *options.minPsnr - m.psnr));
    return list;
}

/// The scale of the heat map: the 99th percentile, so that a few outliers do not make the rest black.
double heatScale(const Metrics& m) {
    for (const double scale : {m.p99, m.maxAbs})
        if (scale > 0) return scale;
    return 1; // equal images, or no figures because of non-finite values
}

std::string placeText(const ValuePlace& place, const Image& image, float value, float reference) {
    return fmt::format("at ({}, {}) {}: {:.6g}, reference {:.6g}", place.x, place.y,
                       image.channels[std::size_t(place.channel)], value, reference);
}

void printLayer(const Layer& layer) {
    const Metrics& m = layer.metrics;
    if (m.nonFinite > 0)
        fmt::print("  {:<15}  {} non-finite\n", oneLine(layer.name), m.nonFinite);
    else
        fmt::print("  {:<15}  MSE {:.6g}, relMSE {:.6g}, maximum error {:.6g}, mean drift {:+.3f} %\n",
                   oneLine(layer.name), m.mse, m.relMse, m.maxAbs, 100 * m.drift);
}

void printTable(const Image& image, const Figures& figures, const Parts& parts, const DiffOptions& options) {
    const Metrics& m = figures.metrics;
    fmt::print("{} against {}: {}x{}, {}\n", options.image, options.reference, image.width(), image.height(),
               fmt::join(image.channels, " "));
    if (m.nonFinite > 0) {
        fmt::print("  non-finite       {}, first {}\n", m.nonFinite,
                   placeText(m.nonFinitePlace, image, m.nonFiniteValue, m.nonFiniteReference));
    } else {
        fmt::print("  MSE              {:.6g}\n  relMSE           {:.6g}\n  PSNR             {:.2f} dB\n",
                   m.mse, m.relMse, m.psnr);
        fmt::print("  FLIP             {:.6g} at {:+g} stops\n", figures.flip, options.exposure);
        fmt::print("  mean error       {:.6g}\n  99th percentile  {:.6g}\n", m.mae, m.p99);
        fmt::print("  maximum error    {:.6g} {}\n", m.maxAbs,
                   placeText(m.maxPlace, image, m.maxValue, m.maxReference));
        fmt::print("  mean drift       {:+.3f} %", 100 * m.drift);
        for (std::size_t c = 0; c < m.channelDrift.size(); ++c)
            fmt::print("{} {} {:+.3f} %", c ? "," : ":", image.channels[c], 100 * m.channelDrift[c]);
        fmt::print("\n");
    }
    for (const Layer& layer : parts.layers) printLayer(layer);
    if (!parts.unpaired.empty())
        fmt::print("  not in both      {}\n", oneLine(fmt::to_string(fmt::join(parts.unpaired, " "))));
    if (!options.heatMap.empty())
        fmt::print("  heat map         {}: 0 to {:.6g}\n", options.heatMap, heatScale(m));
}

nlohmann::ordered_json placeJson(const ValuePlace& place, const Image& image, float value, float reference) {
    return {{"x", place.x},
            {"y", place.y},
            {"channel", image.channels[std::size_t(place.channel)]},
            {"value", value},
            {"reference", reference}};
}

/// JSON has no NaN and no infinity: these become null.
void printJson(const Image& image, const Figures& figures, const Parts& parts, const DiffOptions& options,
               const std::vector<std::string>& outOfBounds) {
    const Metrics& m = figures.metrics;
    nlohmann::ordered_json json = {{"image", options.image},
                                   {"reference", options.reference},
                                   {"width", image.width()},
                                   {"height", image.height()},
                                   {"mse", m.mse},
                                   {"relMse", m.relMse},
                                   {"psnr", m.psnr},
                                   {"flip", figures.flip},
                                   {"flipExposure", options.exposure},
                                   {"mae", m.mae},
                                   {"p99", m.p99},
                                   {"maxAbs", m.maxAbs},
                                   {"drift", m.drift},
                                   {"channelDrift", nlohmann::ordered_json::object()},
                                   {"nonFinite", m.nonFinite},
                                   {"outOfBounds", outOfBounds}};
    for (std::size_t c = 0; c < m.channelDrift.size(); ++c)
        json["channelDrift"][image.channels[c]] = m.channelDrift[c];
    json["layers"] = nlohmann::ordered_json::object();
    for (const Layer& layer : parts.layers)
        json["layers"][layer.name] = {
            {"channels", layer.channels},     {"mse", layer.metrics.mse},
            {"relMse", layer.metrics.relMse}, {"maxAbs", layer.metrics.maxAbs},
            {"drift", layer.metrics.drift},   {"nonFinite", layer.metrics.nonFinite}};
    json["notInBoth"] = parts.unpaired;
    if (m.nonFinite > 0)
        json["firstNonFinite"] = placeJson(m.nonFinitePlace, image, m.nonFiniteValue, m.nonFiniteReference);
    else
        json["worst"] = placeJson(m.maxPlace, image, m.maxValue, m.maxReference);
    if (!options.heatMap.empty()) json["heatMapScale"] = heatScale(m);
    fmt::print("{}\n", json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

void runDiff(const DiffOptions& options) {
    if (!options.heatMap.empty()) checkWritable(options.heatMap);
    const Image first = readLinear(options.image), second = readLinear(options.reference);
    Parts parts = partsOf(first, second);
    const auto coloursOf = [&](const Image& all) {
        return parts.colours.empty() ? all : all.withChannels(parts.colours);
    };
    const Image image = coloursOf(first), reference = coloursOf(second);
    const Figures figures = [&]() -> Figures {
        try {
            return {compare(image, reference),
                    flip(image, reference, {.exposureStops = options.exposure}).mean};
        } catch (const Error& error) {
            throw Error(error.code(), {options.image + " against " + options.reference}, error.what());
        }
    }();
    for (Layer& layer : parts.layers)
        layer.metrics = compare(first.withChannels(layer.channels), second.withChannels(layer.channels));
    if (!options.heatMap.empty())
        writePng(options.heatMap, heatMap(image, reference, heatScale(figures.metrics)));
    const std::vector<std::string> outOfBounds = violations(figures, parts, options);
    if (options.json)
        printJson(image, figures, parts, options, outOfBounds);
    else
        printTable(image, figures, parts, options);
    if (!outOfBounds.empty())
        throw Error(ErrorCode::outOfBounds, fmt::format("out of bounds: {}", fmt::join(outOfBounds, "; ")));
}

} // namespace

void addDiff(CLI::App& program) {
    CLI::App* command = program.add_subcommand("diff", "Compare an image with its reference (EXR or PNG)");
    const auto options = std::make_shared<DiffOptions>();
    command->add_option("IMAGE", options->image, "image to judge")->required()->type_name("");
    command->add_option("REFERENCE", options->reference, "what it should be")->required()->type_name("");
    command->add_flag("--json", options->json, "print JSON instead of a table");
    command->add_option("--heat-map", options->heatMap, "write a picture of the errors")
        ->type_name("FILE.png");
    addNumber<float>(*command, "--exposure", options->exposure, -30, 30,
                     "exposure of the pictures that FLIP compares, in stops (default 0)");
    constexpr double kHuge = 1e30;
    addNumber<double>(*command, "--max-mse", options->maxMse, 0, kHuge, "mean squared error allowed");
    addNumber<double>(*command, "--max-relmse", options->maxRelMse, 0, kHuge,
                      "mean of err^2/(ref^2 + 0.01) allowed");
    addNumber<double>(*command, "--min-psnr", options->minPsnr, -kHuge, kHuge,
                      "lowest PSNR allowed, in dB for a peak of 1");
    addNumber<double>(*command, "--max-abs", options->maxAbs, 0, kHuge, "largest error allowed for a value");
    addNumber<double>(*command, "--max-drift", options->maxDrift, 0, kHuge,
                      "relative change of mean brightness allowed (0.005 = 0.5 %)");
    addNumber<double>(*command, "--max-p99", options->maxP99, 0, kHuge, "99th percentile of errors allowed");
    addNumber<double>(*command, "--max-flip", options->maxFlip, 0, 1, "mean FLIP allowed");
    command->callback([options] { runDiff(*options); });
}

} // namespace slant::commands

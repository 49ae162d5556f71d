// slant info: what a light field file holds.
#include "commands/commands.h"
#include "commands/picture_job.h"
#include "lightfield/field_file.h"
#include "lightfield/refocus.h"
#include "lightfield/summary.h"

#include <cmath>
#include <memory>
#include <numbers>

namespace slant::commands {
namespace {

struct InfoOptions {
    std::string file;
    bool json = false;
};

/// What the slope constants tell about the camera, where they do.
struct DerivedCamera {
    std::optional<double> focusDistance;    ///< of a thin lens; unset: at infinity, or a pinhole
    std::optional<double> pixelsPerTangent; ///< these two where the lens radius is known
    std::optional<double> fovDegrees;       ///< of the film's shorter side
    std::optional<double> fNumber;          ///< where the focal length is known, too
};

DerivedCamera deriveCamera(const FieldFile& file) {
    const SlopeModel& slope = file.field.slopeModel;
    const FieldMetadata& details = file.details;
    DerivedCamera camera;
    const bool thin = isThinLens(file.field);
    if (thin) camera.focusDistance = focusDistance(slope);
    if (thin && slope.c1 < 0 && details.lensRadius > 0) {
        camera.pixelsPerTangent = -double(slope.c1) / double(details.lensRadius);
        const double half = std::min(details.film.width(), details.film.height()) / 2.0;
        camera.fovDegrees = 360 / std::numbers::pi * std::atan(half / *camera.pixelsPerTangent);
    }
    if (details.lensRadius > 0 && details.focalLength > 0)
        camera.fNumber = double(details.focalLength) / (2 * double(details.lensRadius));
    return camera;
}

std::string sizeText(const Rect& r) {
    return fmt::format("{}x{} at ({}, {})", r.width(), r.height(), r.x0, r.y0);
}

std::string rangeText(const ValueRange& range) {
    return range.empty() ? "no finite value" : fmt::format("{:.6g} to {:.6g}", range.low, range.high);
}

std::string slopeText(const LightField& field) {
    const SlopeModel& m = field.slopeModel;
    return fmt::format("{:.9g} / w + {:.9g} pixels per lens radius{}{}", m.c1, m.c2,
                       hasOwnSlopes(field) ? "; samples have their own" : "",
                       field.lensMap.empty() ? "" : ", on the scene's side of a lens map");
}

std::string countsText(const LightField& field) {
    const SampleCounts counts = sampleCounts(field);
    if (field.pixelStart.empty()) return fmt::to_string(counts.max);
    return fmt::format("{} to {} ({:.4g} on average)", counts.min, counts.max, counts.mean);
}

/// The names of the planes of values that a field has.
std::vector<std::string_view> planeNames(const LightField& field) {
    std::vector<std::string_view> names;
    for (std::size_t i = 0; i < kValuePlanes.size(); ++i)
        if (!(field.*kValuePlanes[i]).empty()) names.push_back(kValuePlaneNames[i]);
    return names;
}

void line(std::string_view name, const std::string& value) {
    fmt::print("  {:<15}  {}\n", name, oneLine(value));
}

void printText(const std::string& path, const FieldFile& file, const FieldSummary& summary) {
    const LightField& field = file.field;
    const FieldMetadata& details = file.details;
    fmt::print("{}: light field, {}\n", oneLine(path), nameOf(file.format));
    line("frame", fmt::format("{} of a film of {}", sizeText(field.frame), sizeText(details.film)));
    line("samples", fmt::format("{} in {} pixels, {} each", field.samples.size(), sizeText(field.bounds),
                                countsText(field)));
    line("planes", fmt::to_string(fmt::join(planeNames(field), ", ")));
    line("slope", slopeText(field));

    const DerivedCamera camera = deriveCamera(file);
    const std::string unit = details.unit.empty() ? "" : " " + details.unit;
    if (camera.focusDistance) line("focus distance", fmt::format("{:.6g}{}", *camera.focusDistance, unit));
    if (details.lensRadius > 0) line("lens radius", fmt::format("{:.6g}{}", details.lensRadius, unit));
    if (details.focalLength > 0) line("focal length", fmt::format("{:.6g}{}", details.focalLength, unit));
    if (camera.fNumber) line("f-number", fmt::format("{:.4g}", *camera.fNumber));
    if (camera.fovDegrees)
        line("field of view", fmt::format("{:.4g} degrees, {:.6g} pixels per unit tangent",
                                          *camera.fovDegrees, *camera.pixelsPerTangent));
    line("pixel filter", details.filter ? filterText(*details.filter) : "not named");
    line("aperture", field.aperture.shape().name);
    line("seed", fmt::to_string(details.seed));
    if (!details.source.empty()) line("source", details.source);

    for (std::size_t i = 0; i < summary.ranges.size(); ++i)
        line(FieldSummary::kNames[i], rangeText(summary.ranges[i]));
    line("background", fmt::format("{} samples", summary.background));
    if (summary.moving > 0)
        line("moving",
             fmt::format("{} samples, by up to {:.4g} pixels from shutter open to close, half of them "
                         "by up to {:.4g}",
                         summary.moving, summary.largestMotionPx, summary.medianMotionPx));
    if (summary.outsidePixel > 0) line("outside pixel", fmt::format("{} samples", summary.outsidePixel));
    const FieldDefects& d = summary.defects;
    line("invalid",
         fmt::format("{} of non-finite and {} of negative radiance, {} of bad depth, {} outside the "
                     "lens, {} of bad position, {} of bad motion, {} that come too near",
                     d.nonFiniteRadiance, d.negativeRadiance, d.badDepth, d.outsideLens, d.badPosition,
                     d.badMotion, d.limitedMotion));
}

nlohmann::ordered_json rectJson(const Rect& r) {
    return {{"x0", r.x0}, {"x1", r.x1}, {"y0", r.y0}, {"y1", r.y1}};
}

template <typename Number>
nlohmann::ordered_json orNull(const std::optional<Number>& value) {
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json();
}

void printJson(const std::string& path, const FieldFile& file, const FieldSummary& summary) {
    const LightField& field = file.field;
    const FieldMetadata& details = file.details;
    const DerivedCamera camera = deriveCamera(file);
    const SampleCounts counts = sampleCounts(field);
    const FieldDefects& d = summary.defects;
    nlohmann::ordered_json json = {
        {"file", path},
        {"format", nameOf(file.format)},
        {"film", rectJson(details.film)},
        {"frame", rectJson(field.frame)},
        {"bounds", rectJson(field.bounds)},
        {"samplesPerPixel", {{"least", counts.min}, {"most", counts.max}, {"mean", counts.mean}}},
        {"samples", field.samples.size()},
        {"planes", planeNames(field)},
        {"auxiliary", field.hasGuides()},
        {"c1", field.slopeModel.c1},
        {"c2", field.slopeModel.c2},
        {"ownSlopes", hasOwnSlopes(field)},
        {"lensMap", !field.lensMap.empty()},
        {"focusDistance", orNull(camera.focusDistance)},
        {"pixelsPerTangent", orNull(camera.pixelsPerTangent)},
        {"fovDegrees", orNull(camera.fovDegrees)},
        {"fNumber", orNull(camera.fNumber)},
        {"lensRadius", details.lensRadius},
        {"focalLength", details.focalLength},
        {"unit", details.unit},
        {"aperture", field.aperture.shape().name},
        {"filter", details.filter ? nlohmann::ordered_json(filterText(*details.filter)) : nullptr},
        {"seed", details.seed},
        {"source", details.source},
        {"ranges", nlohmann::ordered_json::object()},
        {"background", summary.background},
        {"moving", summary.moving},
        {"largestMotionPx", summary.largestMotionPx},
        {"medianMotionPx", summary.medianMotionPx},
        {"outsidePixel", summary.outsidePixel},
        {"invalid",
         {{"nonFiniteRadiance", d.nonFiniteRadiance},
          {"negativeRadiance", d.negativeRadiance},
          {"badDepth", d.badDepth},
          {"outsideLens", d.outsideLens},
          {"badPosition", d.badPosition},
          {"badMotion", d.badMotion},
          {"limitedMotion", d.limitedMotion}}}};
    for (std::size_t i = 0; i < summary.ranges.size(); ++i) {
        const ValueRange& range = summary.ranges[i];
        json["ranges"][FieldSummary::kNames[i]] =
            range.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json{range.low, range.high};
    }
    fmt::print("{}\n", json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

void runInfo(const InfoOptions& options) {
    TerminalMonitor monitor(TerminalMonitor::Style::quiet);
    const FieldFile file = readField(options.file, monitor);
    const FieldSummary summary = summarize(file.field);
    (options.json ? printJson : printText)(options.file, file, summary);
}

} // namespace

void addInfo(CLI::App& program) {
    CLI::App* command = program.add_subcommand("info", "Show what a light field file holds");
    const auto options = std::make_shared<InfoOptions>();
    command->add_option("FIELD", options->file, "light field: deep OpenEXR or TLFR")
        ->required()
        ->type_name("");
    command->add_flag("--json", options->json, "print JSON instead of a table");
    command->callback([options] { runInfo(*options); });
}

} // namespace slant::commands

#include "scene/aperture_shape.h"

#include "base/suggest.h"
#include "scene/image_files.h"
#include "scene/spelling.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <numbers>

namespace slant {
namespace {

constexpr int kSectors = ApertureShape::kSectors, kRings = ApertureShape::kRings, kMaxBlades = 100;
/// Lookups into an image per cell, along each direction.
constexpr int kLooks = 8;
constexpr std::string_view kImagePrefix = "image ", kPolygonPrefix = "polygon";
constexpr std::string_view kHexDigits = "0123456789abcdef";

/// Corners at these radii alternately, counter-clockwise from the top.
std::vector<glm::dvec2> corners(int count, double radius, double otherRadius, double degrees) {
    std::vector<glm::dvec2> rim;
    for (int i = 0; i < count; ++i) {
        const double angle = (degrees / 180 + 2.0 * i / count) * std::numbers::pi;
        rim.push_back((i % 2 == 0 ? radius : otherRadius) * glm::dvec2(-std::sin(angle), -std::cos(angle)));
    }
    return rim;
}

/// Weights of the mean of value(p) over each cell, the greatest one fully open; none if all is dark.
template <typename Value>
std::vector<std::uint8_t> weightsOf(const Value& value) {
    std::vector<double> means;
    for (int sector = 0; sector < kSectors; ++sector) {
        std::array<glm::dvec2, kLooks> directions;
        for (int i = 0; i < kLooks; ++i) {
            const double angle = 2 * std::numbers::pi * (sector + (i + 0.5) / kLooks) / kSectors;
            directions[std::size_t(i)] = {std::cos(angle), std::sin(angle)};
        }
        for (int ring = 0; ring < kRings; ++ring) {
            double sum = 0, area = 0;
            for (int i = 0; i < kLooks; ++i) {
                const double radius = (ring + (i + 0.5) / kLooks) / kRings;
                for (const glm::dvec2& direction : directions) sum += radius * value(radius * direction);
                area += radius * kLooks;
            }
            means.push_back(sum / area);
        }
    }
    const double greatest = *std::max_element(means.begin(), means.end());
    std::vector<std::uint8_t> weights;
    if (!(greatest > 0)) return weights;
    for (const double mean : means) weights.push_back(std::uint8_t(std::lround(255 * (mean / greatest))));
    return weights;
}

template <typename Number>
bool takeNumber(std::string_view& text, Number& value) {
    while (text.starts_with(' ')) text.remove_prefix(1);
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc()) return false;
    text.remove_prefix(std::size_t(end - text.data()));
    return text.empty() || text.starts_with(' ');
}

ApertureShape polygon(std::string_view text, const FileLocation& where) {
    std::string_view rest = text.substr(kPolygonPrefix.size());
    int blades = 0;
    float degrees = 0;
    const bool wellFormed =
        takeNumber(rest, blades) && (rest.empty() || (takeNumber(rest, degrees) && rest.empty()));
    if (!wellFormed || blades < 3 || blades > kMaxBlades || !(std::abs(degrees) <= 360))
        throw badInput(where,
                       "aperture \"{}\" is not \"polygon BLADES\" or \"polygon BLADES DEGREES\" with 3 to {} "
                       "blades and at most 360 degrees",
                       printable(text), kMaxBlades);
    return {degrees == 0 ? fmt::format("{} {}", kPolygonPrefix, blades)
                         : fmt::format("{} {} {}", kPolygonPrefix, blades, degrees),
            corners(blades, 1, 1, double(degrees)),
            {}};
}

ApertureShape imageOf(std::string_view digits, const FileLocation& where) {
    ApertureShape shape{"image", {}, std::vector<std::uint8_t>(kSectors * kRings)};
    if (digits.size() != 2 * shape.weights.size() ||
        digits.find_first_not_of(kHexDigits) != std::string_view::npos)
        throw badInput(where, "the weights of an aperture are not {} hexadecimal digits",
                       2 * shape.weights.size());
    const auto digit = [&](std::size_t i) { return kHexDigits.find(digits[i]); };
    bool open = false;
    for (std::size_t i = 0; i < shape.weights.size(); ++i) {
        shape.weights[i] = std::uint8_t(16 * digit(2 * i) + digit(2 * i + 1));
        open = open || shape.weights[i] == 255;
    }
    if (!open) throw badInput(where, "no weight of the aperture is fully open, ff");
    return shape;
}

} // namespace

std::optional<ApertureShape> parseAperture(std::string_view text, const FileLocation& where) {
    if (text == "disc") return ApertureShape{};
    if (text == "gaussian")
        return ApertureShape{"gaussian", {}, weightsOf([](glm::dvec2 p) {
                                 return std::exp(-glm::dot(p, p)) - std::exp(-1.0);
                             })};
    if (text == "square")
        return ApertureShape{"square", corners(4, std::numbers::sqrt2 / 2, std::numbers::sqrt2 / 2, 45), {}};
    if (text == "pentagon") return ApertureShape{"pentagon", corners(5, 0.8, 0.8, 180), {}};
    if (text == "star") {
        const double inner = std::cos(std::numbers::pi * 0.4) / std::cos(std::numbers::pi * 0.2);
        return ApertureShape{"star", corners(10, 1, inner, 90), {}};
    }
    if (text == kPolygonPrefix || text.starts_with("polygon ")) return polygon(text, where);
    if (text.starts_with(kImagePrefix)) return imageOf(text.substr(kImagePrefix.size()), where);
    return {};
}

std::string textOf(const ApertureShape& shape) {
    if (shape.name != "image") return shape.name;
    std::string text(kImagePrefix);
    for (const std::uint8_t weight : shape.weights) {
        text += kHexDigits[weight / 16];
        text += kHexDigits[weight % 16];
    }
    return text;
}

ApertureShape apertureOfImage(const Image& image, const FileLocation& where) {
    const glm::ivec2 last(image.width() - 1, image.height() - 1);
    ApertureShape shape{"image", {}, weightsOf([&](glm::dvec2 p) {
                            const glm::dvec2 place = (p + 1.0) / 2.0 * glm::dvec2(last + 1);
                            const glm::ivec2 pixel = glm::min(glm::ivec2(place), last);
                            return double(std::max(image.at(pixel.x, pixel.y, 0), 0.f));
                        })};
    if (shape.weights.empty())
        throw badInput(where, "the image of the aperture is black within the disc of the lens: no light gets "
                              "through");
    return shape;
}

ApertureShape readAperture(const std::string& text, const std::string& directory, const Position& where) {
    if (text.empty()) return {}; // as in pbrt
    if (!text.starts_with(kImagePrefix))
        if (const std::optional<ApertureShape> shape = parseAperture(text, where)) return *shape;
    constexpr std::array<std::string_view, 6> kNames = {"disc",     "gaussian", "square",
                                                        "pentagon", "star",     "polygon"};
    const std::string path = (std::filesystem::path(directory) / text).string();
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored))
        throw badInput(where, "aperture \"{}\" is not one of {}, nor an image file{}", printable(text),
                       fmt::join(kNames, ", "), didYouMean(text, kNames));
    return apertureOfImage(readImageFile(path, {}, true, where), where);
}

} // namespace slant

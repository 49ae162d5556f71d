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

constexpr int kSide = ApertureShape::kSide, kMaxBlades = 100;
constexpr std::string_view kImagePrefix = "image ", kPolygonPrefix = "polygon";
constexpr std::string_view kHexDigits = "0123456789abcdef";

bool isInDisc(int x, int y) {
    const auto farthest = [](int i) {
        return std::max(std::abs(i - kSide / 2), std::abs(i + 1 - kSide / 2));
    };
    return farthest(x) * farthest(x) + farthest(y) * farthest(y) <= kSide * kSide / 4;
}

/// Corners at these radii in turn, from the top counter-clockwise.
std::vector<glm::dvec2> corners(int count, double radius, double otherRadius, double degrees) {
    std::vector<glm::dvec2> rim;
    for (int i = 0; i < count; ++i) {
        const double angle = (degrees / 180 + 2.0 * i / count) * std::numbers::pi;
        rim.push_back((i % 2 == 0 ? radius : otherRadius) * glm::dvec2(-std::sin(angle), -std::cos(angle)));
    }
    return rim;
}

ApertureShape gaussian() {
    ApertureShape shape{"gaussian", {}, std::vector<std::uint8_t>(kSide * kSide)};
    const double rim = std::exp(-1.0);
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            const glm::dvec2 p = (glm::dvec2(x, y) + 0.5) * (2.0 / kSide) - 1.0;
            const double weight = (std::exp(-glm::dot(p, p)) - rim) / (1 - rim);
            if (isInDisc(x, y))
                shape.weights[std::size_t(y * kSide + x)] = std::uint8_t(std::lround(255 * weight));
        }
    return shape;
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
    ApertureShape shape{"image", {}, std::vector<std::uint8_t>(kSide * kSide)};
    if (digits.size() != 2 * shape.weights.size() ||
        digits.find_first_not_of(kHexDigits) != std::string_view::npos)
        throw badInput(where, "the weights of an aperture are not {} hexadecimal digits",
                       2 * shape.weights.size());
    const auto digit = [&](std::size_t i) { return kHexDigits.find(digits[i]); };
    bool open = false;
    for (std::size_t i = 0; i < shape.weights.size(); ++i) {
        shape.weights[i] = std::uint8_t(16 * digit(2 * i) + digit(2 * i + 1));
        open = open || shape.weights[i] == 255;
        if (shape.weights[i] != 0 && !isInDisc(int(i) % kSide, int(i) / kSide))
            throw badInput(where, "a weight of the aperture outside the lens's disc is not 0");
    }
    if (!open) throw badInput(where, "no weight of the aperture is fully open, ff");
    return shape;
}

/// One row or column of `count` values, `stride` apart, as kSide means over even parts.
void resample(const double* from, std::size_t count, std::size_t stride, double* to, std::size_t toStride) {
    const double step = double(count) / kSide;
    for (std::size_t i = 0; i < kSide; ++i) {
        const double begin = double(i) * step, end = double(i + 1) * step;
        double sum = 0;
        for (auto k = std::size_t(begin); k < count && double(k) < end; ++k)
            sum += (std::min(end, double(k + 1)) - std::max(begin, double(k))) * from[k * stride];
        to[i * toStride] = sum / step;
    }
}

} // namespace

std::optional<ApertureShape> parseAperture(std::string_view text, const FileLocation& where) {
    if (text == "disc") return ApertureShape{};
    if (text == "gaussian") return gaussian();
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
    const auto width = std::size_t(image.width()), height = std::size_t(image.height());
    std::vector<double> grey(width * height), wide(kSide * height), fine(kSide * kSide);
    for (std::size_t i = 0; i < grey.size(); ++i)
        grey[i] = double(std::max(image.pixels[i * image.channels.size()], 0.f));
    for (std::size_t y = 0; y < height; ++y) resample(&grey[y * width], width, 1, &wide[y * kSide], 1);
    for (std::size_t x = 0; x < kSide; ++x) resample(&wide[x], height, kSide, &fine[x], kSide);

    double brightest = 0;
    for (std::size_t i = 0; i < fine.size(); ++i) {
        if (!isInDisc(int(i) % kSide, int(i) / kSide)) fine[i] = 0;
        brightest = std::max(brightest, fine[i]);
    }
    if (!(brightest > 0))
        throw badInput(where, "the image of the aperture is black within the disc of the lens: no light gets "
                              "through");
    ApertureShape shape{"image", {}, {}};
    for (const double value : fine)
        shape.weights.push_back(std::uint8_t(std::lround(255 * (value / brightest))));
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
        throw badInput(where, "aperture \"{}\" is none of {} and no image file{}", printable(text),
                       fmt::join(kNames, ", "), didYouMean(text, kNames));
    return apertureOfImage(readImageFile(path, {}, true, where), where);
}

} // namespace slant

#include "lightfield/field_metadata.h"

#include "base/suggest.h"
#include "scene/spelling.h"

#include <array>
#include <charconv>
#include <cmath>

namespace slant {
namespace {

constexpr float kMaxFilterRadiusPx = 16;

struct FilterName {
    std::string_view name;
    FilterKind kind;
    std::size_t parameters;
};
constexpr std::array<FilterName, 5> kFilters = {{{"box", FilterKind::box, 0},
                                                 {"triangle", FilterKind::triangle, 0},
                                                 {"gaussian", FilterKind::gaussian, 1},
                                                 {"mitchell", FilterKind::mitchell, 2},
                                                 {"sinc", FilterKind::sinc, 1}}};

PixelFilter parseFilter(const FileLocation& location, const std::string& text) {
    const std::string name = text.substr(0, text.find(' '));
    for (const FilterName& entry : kFilters) {
        if (name != entry.name) continue;
        const auto numbers = parseNumbers(std::string_view(text).substr(name.size()), 2 + entry.parameters);
        const auto positive = [](double value) { return value > 0; };
        if (!numbers || !positive((*numbers)[0]) || !positive((*numbers)[1]) ||
            std::max((*numbers)[0], (*numbers)[1]) > kMaxFilterRadiusPx ||
            (entry.parameters == 1 && !positive(numbers->back())))
            throw badInput(location,
                           "filter '{}' is not '{}' with two radii in (0, {}] pixels and {} parameters", text,
                           name, kMaxFilterRadiusPx, entry.parameters);
        PixelFilter filter{entry.kind, {float((*numbers)[0]), float((*numbers)[1])}};
        if (entry.kind == FilterKind::gaussian) filter.sigma = float((*numbers)[2]);
        if (entry.kind == FilterKind::mitchell)
            filter.b = float((*numbers)[2]), filter.c = float((*numbers)[3]);
        if (entry.kind == FilterKind::sinc) filter.tau = float((*numbers)[2]);
        return filter;
    }
    std::array<std::string_view, kFilters.size()> names;
    for (std::size_t i = 0; i < names.size(); ++i) names[i] = kFilters[i].name;
    throw badInput(location, "filter '{}' is none of {}{}", name, fmt::join(names, ", "),
                   didYouMean(name, names));
}

float parseLength(const FileLocation& location, std::string_view name, const std::string& text) {
    const auto numbers = parseNumbers(text, 1);
    const float value = numbers ? float(numbers->front()) : -1;
    if (!(value >= 0) || !std::isfinite(value))
        throw badInput(location, "{} '{}' is not a length of zero or more", name, text);
    return value;
}

Aperture readShape(const FileLocation& location, const std::string& text) {
    const std::optional<ApertureShape> shape = parseAperture(text, location);
    if (!shape) throw badInput(location, "aperture '{}' is not a known shape", printable(text));
    return Aperture(*shape);
}

std::uint64_t parseSeed(const FileLocation& location, const std::string& text) {
    std::uint64_t seed = 0;
    const char* const last = text.data() + text.size();
    const auto [end, error] = std::from_chars(text.data(), last, seed);
    if (error != std::errc() || end != last)
        throw badInput(location, "seed '{}' is not a whole number of 64 bits", text);
    return seed;
}

} // namespace

std::string filterText(const PixelFilter& filter) {
    const auto& entry = *std::find_if(kFilters.begin(), kFilters.end(),
                                      [&](const FilterName& each) { return each.kind == filter.kind; });
    std::string text = fmt::format("{} {} {}", entry.name, filter.radius.x, filter.radius.y);
    if (filter.kind == FilterKind::gaussian) text += fmt::format(" {}", filter.sigma);
    if (filter.kind == FilterKind::mitchell) text += fmt::format(" {} {}", filter.b, filter.c);
    if (filter.kind == FilterKind::sinc) text += fmt::format(" {}", filter.tau);
    return text;
}

std::optional<std::vector<double>> parseNumbers(std::string_view text, std::size_t count) {
    std::vector<double> numbers;
    const char *place = text.data(), *const last = text.data() + text.size();
    for (;;) {
        while (place != last && *place == ' ') ++place;
        if (place == last) break;
        double value = 0;
        const auto [end, error] = std::from_chars(place, last, value);
        if (error != std::errc() || !std::isfinite(value) || (end != last && *end != ' ')) return {};
        numbers.push_back(value);
        place = end;
    }
    if (numbers.size() != count) return {};
    return numbers;
}

Metadata metadataOf(const LightField& field, const FieldMetadata& details) {
    Metadata metadata{{"slant:seed", fmt::to_string(details.seed)}};
    if (!field.aperture.isDisc()) metadata["slant:aperture"] = textOf(field.aperture.shape());
    if (details.filter) metadata["slant:filter"] = filterText(*details.filter);
    if (details.lensRadius > 0) metadata["slant:lensRadius"] = details.lensRadius;
    if (details.focalLength > 0) metadata["slant:focalLength"] = details.focalLength;
    if (!details.unit.empty()) metadata["slant:unit"] = details.unit;
    if (!details.source.empty()) metadata["slant:source"] = details.source;
    return metadata;
}

bool setMetadata(LightField& field, FieldMetadata& details, const FileLocation& location,
                 std::string_view name, const std::string& value) {
    if (name == "filter")
        details.filter = parseFilter(location, value);
    else if (name == "aperture")
        field.aperture = readShape(location, value);
    else if (name == "lensRadius")
        details.lensRadius = parseLength(location, name, value);
    else if (name == "focalLength")
        details.focalLength = parseLength(location, name, value);
    else if (name == "unit")
        details.unit = value;
    else if (name == "source")
        details.source = value;
    else if (name == "seed")
        details.seed = parseSeed(location, value);
    else
        return false;
    return true;
}

} // namespace slant

#include "lightfield/field_file.h"

#include "base/input_file.h"
#include "lightfield/deep_exr.h"
#include "lightfield/tlfr.h"

#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <stdexcept>

namespace slant {
namespace {

constexpr int kMaxCoordinate = 1 << 20;
constexpr int kMaxSamplesPerPixel = 1 << 16;

bool withinLimits(const Rect& r) {
    return r.x0 >= -kMaxCoordinate && r.y0 >= -kMaxCoordinate && r.x1 <= kMaxCoordinate &&
           r.y1 <= kMaxCoordinate;
}

std::string textOf(const Rect& r) {
    return fmt::format("[{}, {}) x [{}, {})", r.x0, r.x1, r.y0, r.y1);
}

void checkTotal(const FileLocation& location, std::uint64_t samples) {
    if (samples >= std::numeric_limits<std::uint32_t>::max())
        throw badInput(location, "{} samples are not fewer than 2^32 - 1", samples);
}

bool isOpenExr(const std::string& path) {
    constexpr char kMagic[4] = {0x76, 0x2f, 0x31, 0x01};
    const InputFile file(path);
    char start[4];
    if (file.size() < sizeof start) return false;
    file.read(0, start, sizeof start);
    return std::memcmp(start, kMagic, sizeof start) == 0;
}

template <typename Action>
void allocate(std::size_t samples, const Action& action) {
    try {
        action();
    } catch (const std::exception&) { // bad_alloc or length_error
        throw Error(ErrorCode::resources, fmt::format("no memory for {} samples", samples));
    }
}

} // namespace

std::string_view nameOf(FieldFormat format) {
    switch (format) {
    case FieldFormat::deepExr:
        return "deep OpenEXR";
    case FieldFormat::tlfrBinary:
        return "TLFR 1.3, binary";
    case FieldFormat::tlfrText:
        return "TLFR 1.3, text";
    }
    return "";
}

FieldFormat formatForName(const std::string& path) {
    const std::string extension = std::filesystem::path(path).extension().string();
    if (extension == ".exr") return FieldFormat::deepExr;
    if (extension == ".bin") return FieldFormat::tlfrBinary;
    if (extension == ".txt") return FieldFormat::tlfrText;
    throw Error(
        ErrorCode::usage,
        fmt::format("'{}': a light field's name ends in .exr (deep OpenEXR), .bin or .txt (TLFR)", path));
}

FieldFile readField(const std::string& path, Monitor& monitor) {
    const std::string header = ".header";
    const std::string body = path.ends_with(header) ? path.substr(0, path.size() - header.size()) : path;
    std::error_code ignored;
    if (body == path && isOpenExr(path)) {
        FieldFile file = readDeepExr(path, monitor);
        if (!file.field.lensMap.empty() && file.field.samplesPerPixel == 0)
            throw badInput({path}, "has a lens map, but pixels that differ in their number of samples");
        return file;
    }
    if (std::filesystem::exists(body + header, ignored)) return readTlfr(body, body + header, monitor);
    throw badInput({path}, "is not a light field: neither OpenEXR nor TLFR, as there is no {}{}", body,
                   header);
}

void writeField(const std::string& path, const LightField& field, const FieldMetadata& details,
                Monitor& monitor) {
    const FieldFormat format = formatForName(path);
    if (format == FieldFormat::deepExr)
        writeDeepExr(path, field, details, monitor);
    else
        writeTlfr(path, field, details, format == FieldFormat::tlfrText, monitor);
}

void checkExtent(const FileLocation& location, const LightField& field, const FieldMetadata& details) {
    for (const auto& [name, rect] : {std::pair("samples", field.bounds), {"film", details.film}})
        if (rect.empty() || !withinLimits(rect))
            throw badInput(location, "the {} span {} pixels: empty or not within +-{}", name, textOf(rect),
                           kMaxCoordinate);
    if (field.frame.empty() || field.frame.intersect(field.bounds) != field.frame)
        throw badInput(location, "the frame {} is not part of the pixels with samples, {}",
                       textOf(field.frame), textOf(field.bounds));
    if (field.samplesPerPixel < 1 || field.samplesPerPixel > kMaxSamplesPerPixel)
        throw badInput(location, "{} samples per pixel are not 1 to {}", field.samplesPerPixel,
                       kMaxSamplesPerPixel);
    checkTotal(location, std::uint64_t(field.bounds.area()) * std::uint64_t(field.samplesPerPixel));
    const SlopeModel& slope = field.slopeModel;
    for (const float constant : {slope.c1, slope.c2})
        if (!std::isfinite(constant))
            throw badInput(location, "a slope constant is not finite: {}", constant);
    if (slope.c1 > 0)
        throw badInput(
            location,
            "the slope constant C1 = {} is positive: what is near would lie behind what is far. Turn "
            "the lens coordinates round (-u, -v, -C1, -C2)",
            slope.c1);
}

void takeSampleCounts(const FileLocation& location, LightField& field,
                      std::span<const std::uint32_t> counts) {
    std::uint64_t samples = 0;
    for (const std::uint32_t count : counts) {
        if (count > std::uint32_t(kMaxSamplesPerPixel))
            throw badInput(location, "{} samples in a pixel are more than {}", count, kMaxSamplesPerPixel);
        samples += count;
    }
    if (samples == 0) throw badInput(location, "holds no samples");
    checkTotal(location, samples);
    setSampleCounts(field, counts);
}

LensMap lensMapOf(const FileLocation& location, std::span<const float> numbers) {
    std::vector<vec4> texels(numbers.size() / 4);
    for (std::size_t i = 0; i < 4 * texels.size(); ++i) texels[i / 4][int(i % 4)] = numbers[i];
    if (numbers.size() % 4 != 0)
        throw badInput(location, "lensMap has {} numbers, which is not a multiple of 4", numbers.size());
    if (const char* fault = faultOf(texels)) throw badInput(location, "lensMap {}", fault);
    return LensMap(std::move(texels));
}

std::span<const float> numbersOf(const LensMap& map) {
    static_assert(sizeof(vec4) == 4 * sizeof(float));
    if (map.empty()) return {};
    return {&map.texels()[0].x, 4 * map.texels().size()};
}

void allocateSamples(LightField& field, SamplePlanes planes) {
    const std::size_t count = field.firstSample(field.bounds.area());
    allocate(count, [&] { field.resize(count, planes); });
}

void allocateMotion(LightField& field) {
    allocate(field.samples.size(), [&] { field.motion.assign(field.samples.size(), glm::vec3(0)); });
}

} // namespace slant

#include "image/picture.h"

#include "base/error.h"
#include "base/read_file.h"
#include "image/exr.h"
#include "image/png.h"
#include "image/radiance.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <memory>
#include <string_view>

// stb_image, for JPEG and TGA.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wunused-function"
#define STBI_ONLY_JPEG
#define STBI_ONLY_TGA
#define STBI_NO_HDR
#define STBI_NO_LINEAR
#define STBI_NO_STDIO
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace slant {
namespace {

constexpr std::size_t kMaxPixels = std::size_t(1) << 27;
/// More than any of these kinds packs into a byte; a small file must not ask for much memory.
constexpr std::size_t kMaxPixelsPerByte = 1024;

Image emptyImage(const std::string& path, std::size_t bytes, int width, int height, int channels) {
    if (width <= 0 || height <= 0 || std::size_t(width) * std::size_t(height) > kMaxPixels)
        throw badInput({path}, "{}x{} pixels are more than the limit of {}, or none", width, height,
                       kMaxPixels);
    if (std::size_t(width) * std::size_t(height) / kMaxPixelsPerByte > bytes)
        throw badInput({path}, "is cut short: {} bytes cannot hold {}x{} pixels", bytes, width, height);
    static const std::vector<std::string> kNames[] = {
        {"Y"}, {"Y", "A"}, {"R", "G", "B"}, {"R", "G", "B", "A"}};
    return {{0, 0, width, height}, kNames[channels - 1]};
}

struct FreePixels {
    void operator()(stbi_uc* pixels) const { stbi_image_free(pixels); }
};
using Pixels = std::unique_ptr<stbi_uc, FreePixels>;

Pixels decode(const std::string& bytes, int& width, int& height, int& channels) {
    const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
    return Pixels(stbi_load_from_memory(data, int(bytes.size()), &width, &height, &channels, 0));
}

Image decodeStb(const std::string& path, std::string bytes, const char* kind) {
    constexpr std::size_t kMaxBytes = std::size_t(1) << 30;
    if (bytes.size() > kMaxBytes)
        throw badInput({path}, "{} bytes are too many for a {}", bytes.size(), kind);
    int width = 0, height = 0, channels = 0;
    const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
    if (!stbi_info_from_memory(data, int(bytes.size()), &width, &height, &channels))
        throw badInput({path}, "is not a {} that can be read: {}", kind, stbi_failure_reason());
    Image image = emptyImage(path, bytes.size(), width, height, channels);
    const Pixels pixels = decode(bytes, width, height, channels);
    if (!pixels) throw badInput({path}, "the {} is damaged: {}", kind, stbi_failure_reason());
    if (width != image.width() || height != image.height() || channels != image.channelCount())
        throw badInput({path}, "the {} is damaged: its header does not fit its pixels", kind);
    // The decoder takes zeros for what is missing. If other bytes there make another picture, it was cut
    // short.
    constexpr std::size_t kPadding = 1 << 16;
    bytes.append(kPadding, '\x55');
    const Pixels padded = decode(bytes, width, height, channels);
    if (!padded || std::memcmp(pixels.get(), padded.get(), image.pixels.size()) != 0)
        throw badInput({path}, "the {} is cut short", kind);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = float(pixels.get()[i]) / 255.f;
    return image;
}

/// Portable float map: "PF" or "Pf", width, height, a scale whose sign is the order of bytes, then rows of
/// floats from the bottom up.
Image readPfm(const std::string& path, const std::string& bytes) {
    std::string_view rest(bytes);
    const auto word = [&] {
        const auto isBlank = [](char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; };
        while (!rest.empty() && isBlank(rest.front())) rest.remove_prefix(1);
        std::size_t length = 0;
        while (length < rest.size() && !isBlank(rest[length])) ++length;
        const std::string_view found = rest.substr(0, length);
        rest.remove_prefix(std::min(rest.size(), length + 1)); // one blank ends the header
        return found;
    };
    const auto number = [&](auto value) {
        const std::string_view text = word();
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error != std::errc() || end != text.data() + text.size())
            throw badInput({path}, "the header of this PFM is damaged");
        return value;
    };
    const int channels = word() == "PF" ? 3 : 1;
    const int width = number(0), height = number(0);
    const float scale = number(0.f);
    Image image = emptyImage(path, rest.size(), width, height, channels);
    const std::size_t rowValues = std::size_t(width) * std::size_t(channels);
    if (rest.size() / sizeof(float) < image.pixels.size()) throw badInput({path}, "the PFM is cut short");
    for (int y = height - 1; y >= 0; --y, rest.remove_prefix(rowValues * sizeof(float)))
        for (std::size_t i = 0; i < rowValues; ++i) {
            char value[sizeof(float)];
            std::memcpy(value, rest.data() + i * sizeof(float), sizeof value);
            if (scale > 0) std::reverse(std::begin(value), std::end(value)); // big-endian
            float& pixel = image.pixels[std::size_t(y) * rowValues + i];
            std::memcpy(&pixel, value, sizeof value);
            if (scale != 0) pixel *= std::abs(scale);
        }
    return image;
}

bool endsLikeTga(std::string_view path) {
    std::string ending(path.substr(path.size() < 4 ? 0 : path.size() - 4));
    for (char& c : ending) c = char(std::tolower(static_cast<unsigned char>(c)));
    return ending == ".tga";
}

} // namespace

Picture readPicture(const std::string& path) {
    std::string bytes = readFile(path);
    const auto begins = [&](std::string_view signature) { return bytes.starts_with(signature); };
    if (begins("\x89PNG")) return {readPng(path), true};
    if (begins("\x76\x2f\x31\x01")) return {readExr(path).image, false};
    if (begins("\xff\xd8\xff")) return {decodeStb(path, std::move(bytes), "JPEG"), true};
    if (begins("#?RADIANCE") || begins("#?RGBE")) return {parseRadiance(bytes, path), false};
    if (begins("PF\n") || begins("Pf\n") || begins("PF\r") || begins("Pf\r"))
        return {readPfm(path, bytes), false};
    if (endsLikeTga(path)) return {decodeStb(path, std::move(bytes), "TGA"), true};
    throw badInput({path},
                   "is a picture of an unknown kind: PNG, OpenEXR, JPEG, TGA, Radiance HDR and PFM are read");
}

} // namespace slant

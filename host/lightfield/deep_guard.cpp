#include "lightfield/deep_guard.h"

#include <algorithm>
#include <string>
#include <string_view>

namespace slant {
namespace {

struct FixedSize {
    std::string_view type;
    int bytes;
};
/// OpenEXR reads these without checking the size that the file gives, and would misread what follows.
constexpr std::array<FixedSize, 24> kFixedSizes = {{
    {"box2f", 16},
    {"box2i", 16},
    {"chromaticities", 32},
    {"compression", 1},
    {"deepImageState", 1},
    {"double", 8},
    {"envmap", 1},
    {"float", 4},
    {"int", 4},
    {"keycode", 28},
    {"lineOrder", 1},
    {"m33d", 72},
    {"m33f", 36},
    {"m44d", 128},
    {"m44f", 64},
    {"rational", 8},
    {"tiledesc", 9},
    {"timecode", 8},
    {"v2d", 16},
    {"v2f", 8},
    {"v2i", 8},
    {"v3d", 24},
    {"v3f", 12},
    {"v3i", 12},
}};

/// Bytes up to the next zero; those of names are fewer than 256.
std::string readName(FileStream& stream) {
    std::string name;
    for (char c = 0; stream.read(&c, 1), c != 0; name += c)
        if (name.size() == 255) throw Iex::InputExc("a name in the header does not end");
    return name;
}

/// Channels, each a name and 16 bytes, up to an empty name.
void skipChannels(FileStream& stream) {
    constexpr std::uint64_t kChannelBytes = 16;
    while (!readName(stream).empty()) stream.seekg(stream.tellg() + kChannelBytes);
}

/// Width, height, and 4 bytes per pixel.
void skipPreview(FileStream& stream) {
    const std::uint64_t width = readNumber<std::uint32_t>(stream), height = readNumber<std::uint32_t>(stream);
    if (width > 0xffff || height > 0xffff) throw Iex::InputExc("a preview is too large");
    stream.seekg(stream.tellg() + 4 * width * height);
}

/// Each a length and that many bytes.
void skipStrings(FileStream& stream, std::uint64_t end) {
    while (stream.tellg() < end) {
        const auto length = readNumber<std::uint32_t>(stream);
        stream.seekg(stream.tellg() + length);
    }
}

/// To the end of an attribute's value as OpenEXR finds it.
void skipValue(FileStream& stream, const std::string& type, std::uint64_t size) {
    const std::uint64_t begin = stream.tellg();
    const auto fixed = std::find_if(kFixedSizes.begin(), kFixedSizes.end(),
                                    [&](const FixedSize& entry) { return entry.type == type; });
    if (fixed != kFixedSizes.end())
        stream.seekg(begin + std::uint64_t(fixed->bytes));
    else if (type == "chlist")
        skipChannels(stream);
    else if (type == "preview")
        skipPreview(stream);
    else if (type == "stringvector")
        skipStrings(stream, begin + size);
    else if (type == "floatvector")
        stream.seekg(begin + size / sizeof(float) * sizeof(float));
    else
        stream.seekg(begin + size);
}

} // namespace

void checkAttributes(const InputFile& file) {
    FileStream stream(file);
    stream.seekg(kVersionPlace);
    readNumber<std::int32_t>(stream);
    while (!readName(stream).empty()) {
        const std::string type = readName(stream);
        const int size = readNumber<std::int32_t>(stream);
        const std::uint64_t begin = stream.tellg();
        if (size < 0 || std::uint64_t(size) > file.size() - begin)
            throw Iex::InputExc("an attribute is longer than the file");
        const std::uint64_t end = begin + std::uint64_t(size);
        skipValue(stream, type, std::uint64_t(size));
        if (stream.tellg() != end) throw Iex::InputExc("an attribute does not have the size of its type");
    }
}

void checkScanlines(const InputFile& file, std::uint64_t table, int count) {
    FileStream stream(file);
    for (int line = 0; line < count; ++line) {
        stream.seekg(table + sizeof(std::uint64_t) * std::uint64_t(line));
        stream.seekg(readNumber<std::uint64_t>(stream));
        readNumber<std::int32_t>(stream); // y
        const auto counts = readNumber<std::uint64_t>(stream), packed = readNumber<std::uint64_t>(stream);
        const auto unpacked = readNumber<std::uint64_t>(stream);
        if (counts > file.size() || packed > file.size() || unpacked / kLargestRatio > packed)
            throw Iex::InputExc("a scanline is longer than the file");
    }
}

} // namespace slant

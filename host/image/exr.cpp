#include "image/exr.h"

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/read_file.h"

#include <ImathBox.h>
#include <OpenEXR/Iex.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfTestFile.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <half.h>
#include <tuple>

namespace slant {
namespace {

constexpr std::size_t kMaxPixels = std::size_t(1) << 27;
constexpr std::size_t kMaxValues = std::size_t(1) << 29;

/// OpenEXR attributes of types that Metadata has, but which are not ours.
constexpr std::array kStandardAttributes = {"pixelAspectRatio", "screenWindowWidth", "type", "chunkCount",
                                            "dwaCompressionLevel"};

/// Collects the file, so that OpenEXR never sees a full disk: its destructors would swallow the error.
class MemoryOutput final : public Imf::OStream {
public:
    MemoryOutput() : OStream("memory") {}
    void write(const char data[], int count) override {
        bytes_.resize(std::max(bytes_.size(), position_ + std::size_t(count)));
        std::memcpy(bytes_.data() + position_, data, std::size_t(count));
        position_ += std::size_t(count);
    }
    std::uint64_t tellp() override { return position_; }
    void seekp(std::uint64_t position) override { position_ = position; }

    const std::string& bytes() const { return bytes_; }

private:
    std::string bytes_;
    std::size_t position_ = 0;
};

class MemoryInput final : public Imf::IStream {
public:
    explicit MemoryInput(const std::string& bytes) : IStream("memory"), bytes_(bytes) {}
    bool read(char data[], int count) override {
        if (position_ > bytes_.size() || std::size_t(count) > bytes_.size() - position_)
            throw Iex::InputExc("it ends early");
        std::memcpy(data, bytes_.data() + position_, std::size_t(count));
        position_ += std::size_t(count);
        return position_ < bytes_.size();
    }
    std::uint64_t tellg() override { return position_; }
    void seekg(std::uint64_t position) override { position_ = position; }

private:
    const std::string& bytes_;
    std::size_t position_ = 0;
};

Imath::Box2i toBox(const Rect& r) {
    return {{r.x0, r.y0}, {r.x1 - 1, r.y1 - 1}};
}

/// The header check of OpenEXR keeps the coordinates of a window within half of the range of int.
Rect toRect(const Imath::Box2i& b) {
    return {b.min.x, b.min.y, b.max.x + 1, b.max.y + 1};
}

/// Slices of interleaved pixels: OpenEXR wants the address of pixel (0, 0), which may lie outside.
template <typename Value>
Imf::FrameBuffer frameBuffer(Imf::PixelType type, const Value* pixels, const Image& image) {
    const std::size_t xStride = sizeof(Value) * image.channels.size();
    const std::size_t yStride = xStride * std::size_t(image.width());
    Imf::FrameBuffer buffer;
    for (std::size_t c = 0; c < image.channels.size(); ++c) {
        char* first = reinterpret_cast<char*>(const_cast<Value*>(pixels + c));
        buffer.insert(image.channels[c],
                      Imf::Slice::Make(type, first, toBox(image.dataWindow), xStride, yStride));
    }
    return buffer;
}

half toHalf(float value) {
    return half(std::isfinite(value) ? std::clamp(value, -float(HALF_MAX), float(HALF_MAX)) : value);
}

Imf::Header makeHeader(const Image& image, const Metadata& metadata, Imf::PixelType type) {
    Imf::Header header(toBox(image.displayWindow), toBox(image.dataWindow));
    header.compression() = Imf::ZIP_COMPRESSION;
    for (const std::string& name : image.channels) header.channels().insert(name, Imf::Channel(type));
    for (const auto& [name, value] : metadata) {
        if (const auto* text = std::get_if<std::string>(&value))
            header.insert(name, Imf::StringAttribute(*text));
        else if (const auto* number = std::get_if<float>(&value))
            header.insert(name, Imf::FloatAttribute(*number));
        else
            header.insert(name, Imf::IntAttribute(std::get<int>(value)));
    }
    return header;
}

void encode(MemoryOutput& stream, const Image& image, const Metadata& metadata, ExrPrecision precision) {
    const Imf::PixelType type = precision == ExrPrecision::half ? Imf::HALF : Imf::FLOAT;
    Imf::OutputFile file(stream, makeHeader(image, metadata, type));
    std::vector<half> halves;
    if (precision == ExrPrecision::half) {
        halves.resize(image.pixels.size());
        std::transform(image.pixels.begin(), image.pixels.end(), halves.begin(), toHalf);
        file.setFrameBuffer(frameBuffer(type, halves.data(), image));
    } else {
        file.setFrameBuffer(frameBuffer(type, image.pixels.data(), image));
    }
    file.writePixels(image.height());
}

Metadata readMetadata(const Imf::Header& header) {
    Metadata metadata;
    for (auto i = header.begin(); i != header.end(); ++i) {
        const std::string name = i.name();
        if (std::find(kStandardAttributes.begin(), kStandardAttributes.end(), name) !=
            kStandardAttributes.end())
            continue;
        if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&i.attribute()))
            metadata[name] = text->value();
        else if (const auto* number = dynamic_cast<const Imf::FloatAttribute*>(&i.attribute()))
            metadata[name] = number->value();
        else if (const auto* integer = dynamic_cast<const Imf::IntAttribute*>(&i.attribute()))
            metadata[name] = integer->value();
    }
    return metadata;
}

/// Orders channels by layer, then R, G, B, A, then name.
auto channelKey(const std::string& name) {
    const std::size_t dot = name.rfind('.');
    const std::string layer = dot == std::string::npos ? "" : name.substr(0, dot);
    const std::string last = dot == std::string::npos ? name : name.substr(dot + 1);
    const std::size_t place = last.size() == 1 ? std::string_view("RGBA").find(last[0]) : std::string::npos;
    return std::tuple(layer, place, last);
}

std::vector<std::string> channelNames(const std::string& path, const Imf::Header& header) {
    std::vector<std::string> names;
    for (auto i = header.channels().begin(); i != header.channels().end(); ++i) {
        if (i.channel().xSampling != 1 || i.channel().ySampling != 1)
            throw badInput({path}, "channel '{}' is subsampled, which is not read", i.name());
        names.push_back(i.name());
    }
    if (names.empty()) throw badInput({path}, "the EXR file has no channels");
    std::sort(names.begin(), names.end(),
              [](const auto& a, const auto& b) { return channelKey(a) < channelKey(b); });
    return names;
}

void checkKind(const std::string& path, MemoryInput& stream) {
    bool tiled = false, deep = false, multiPart = false;
    if (!Imf::isOpenExrFile(stream, tiled, deep, multiPart)) throw badInput({path}, "is not an OpenEXR file");
    stream.seekg(0);
    const char* kind = multiPart ? "multi-part" : deep ? "deep" : tiled ? "tiled" : nullptr;
    if (kind) throw badInput({path}, "is a {} EXR file; images are read from flat scanline files", kind);
}

ExrFile decode(const std::string& path, MemoryInput& stream) {
    Imf::InputFile file(stream);
    const Imf::Header& header = file.header();
    const Rect window = toRect(header.dataWindow());
    std::vector<std::string> names = channelNames(path, header);
    if (window.area() > kMaxPixels || window.area() * names.size() > kMaxValues)
        throw badInput(
            {path}, "{}x{} pixels of {} channels are more than the 2^27 pixels or 2^29 values that are read",
            window.width(), window.height(), names.size());
    ExrFile result{Image(window, std::move(names)), readMetadata(header)};
    result.image.displayWindow = toRect(header.displayWindow());
    file.setFrameBuffer(frameBuffer(Imf::FLOAT, result.image.pixels.data(), result.image));
    file.readPixels(header.dataWindow().min.y, header.dataWindow().max.y);
    return result;
}

} // namespace

void writeExr(const std::string& path, const Image& image, const Metadata& metadata, ExrPrecision precision) {
    AtomicFile file(path);
    MemoryOutput stream;
    try {
        encode(stream, image, metadata, precision);
    } catch (const Iex::BaseExc& error) {
        throw Error(ErrorCode::resources, {path}, fmt::format("cannot encode as EXR: {}", error.what()));
    }
    file.write(stream.bytes());
    file.commit();
}

ExrFile readExr(const std::string& path) {
    const std::string bytes = readFile(path);
    try {
        MemoryInput stream(bytes);
        checkKind(path, stream);
        return decode(path, stream);
    } catch (const Iex::BaseExc& error) {
        throw badInput({path}, "is a damaged EXR file: {}", error.what());
    }
}

} // namespace slant

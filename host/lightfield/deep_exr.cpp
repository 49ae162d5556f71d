#include "lightfield/deep_exr.h"

#include "base/atomic_file.h"
#include "base/input_file.h"
#include "lightfield/deep_guard.h"
#include "lightfield/deep_row.h"

#include <ImathBox.h>
#include <OpenEXR/Iex.h>
#include <OpenEXR/ImfBoxAttribute.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDeepScanLineInputFile.h>
#include <OpenEXR/ImfDeepScanLineOutputFile.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfFloatVectorAttribute.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfTestFile.h>
#include <OpenEXR/ImfVersion.h>
#include <algorithm>
#include <cmath>
#include <iterator>

namespace slant {
namespace {

constexpr int kVersion = 1;
/// The fewest bytes that a sample takes before compression: the required channels, three of them as halves at
/// most.
constexpr std::uint64_t kMinSampleBytes = 22;

struct SlopeConstant {
    const char* name;
    float SlopeModel::*value;
};
/// Needed unless every sample has a slope.
constexpr std::array<SlopeConstant, 2> kSlopeConstants = {
    {{"slant:c1", &SlopeModel::c1}, {"slant:c2", &SlopeModel::c2}}};
constexpr const char* kLensMap = "slant:lensMap";

Imath::Box2i toBox(const Rect& r) {
    return {{r.x0, r.y0}, {r.x1 - 1, r.y1 - 1}};
}

/// Clamped to slightly more than any valid extent.
Rect toRect(const Imath::Box2i& b) {
    constexpr int kLimit = 1 << 29;
    const auto clamped = [=](int v) { return std::clamp(v, -kLimit, kLimit); };
    return {clamped(b.min.x), clamped(b.min.y), clamped(b.max.x) + 1, clamped(b.max.y) + 1};
}

/// Remembers a failure, since OpenEXR's destructors swallow errors.
class OutputStream final : public Imf::OStream {
public:
    OutputStream(AtomicFile& file, const std::string& path) : OStream(path.c_str()), file_(file) {}
    void write(const char data[], int count) override {
        guarded([&] { file_.write(data, std::size_t(count)); });
        position_ += std::uint64_t(count);
    }
    std::uint64_t tellp() override { return position_; }
    void seekp(std::uint64_t position) override {
        guarded([&] { file_.seek(position); });
        position_ = position;
    }
    void rethrow() const {
        if (failure_) std::rethrow_exception(failure_);
    }

private:
    template <typename Action>
    void guarded(const Action& action) {
        try {
            action();
        } catch (...) {
            failure_ = std::current_exception();
            throw Iex::IoExc("cannot write");
        }
    }

    AtomicFile& file_;
    std::uint64_t position_ = 0;
    std::exception_ptr failure_;
};

// ---------------------------------------------------------------- header

template <typename Attribute>
const Attribute* find(const Imf::Header& header, const std::string& name) {
    return header.findTypedAttribute<Attribute>(name.c_str());
}

void requireBytes(const InputFile& file, std::uint64_t pixels, std::uint64_t samples) {
    if ((pixels * sizeof(unsigned) + samples * kMinSampleBytes) / kLargestRatio > file.size())
        throw badInput({file.path()}, "{} bytes cannot hold {} pixels and {} samples", file.size(), pixels,
                       samples);
}

/// The header, before OpenEXR allocates anything of the sizes that it speaks of.
Imf::Header readHeader(const InputFile& file) {
    FileStream stream(file);
    bool tiled = false, deep = false, multiPart = false;
    if (!Imf::isOpenExrFile(stream, tiled, deep, multiPart) || !deep || tiled || multiPart)
        throw badInput({file.path()}, "is not a light field: it is {}",
                       multiPart ? "a multi-part OpenEXR file" : "an OpenEXR file without deep scanlines");
    checkAttributes(file);
    stream.seekg(kVersionPlace);
    int version = readNumber<std::int32_t>(stream);
    Imf::Header header;
    header.readFrom(stream, version);
    header.sanityCheck();
    if (!header.hasType() || header.type() != Imf::DEEPSCANLINE)
        throw badInput({file.path()}, "is not a light field: its type is not '{}'", Imf::DEEPSCANLINE);
    const Imath::Box2i& window = header.dataWindow();
    requireBytes(file, std::uint64_t(window.max.y) - std::uint64_t(window.min.y), 0);
    checkScanlines(file, stream.tellg(), window.max.y - window.min.y + 1);
    return header;
}

/// Constants and details.
void readAttributes(const FileLocation& where, const Imf::Header& header, bool slopesGiven, FieldFile& file) {
    if (const auto* version = find<Imf::IntAttribute>(header, "slant:version"))
        if (version->value() != kVersion)
            throw badInput(where, "slant:version {} is not {}", version->value(), kVersion);
    for (const SlopeConstant& constant : kSlopeConstants) {
        const auto* attribute = find<Imf::FloatAttribute>(header, constant.name);
        if (attribute)
            file.field.slopeModel.*constant.value = attribute->value();
        else if (!slopesGiven)
            throw badInput(where, "has neither the float attribute '{}' nor a channel 'slope'",
                           constant.name);
    }
    if (const auto* map = find<Imf::FloatVectorAttribute>(header, kLensMap))
        file.field.lensMap = lensMapOf(where, map->value());
    for (auto i = header.begin(); i != header.end(); ++i) {
        const std::string name = i.name(), prefix = "slant:";
        if (!name.starts_with(prefix)) continue;
        if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&i.attribute()))
            setMetadata(file.field, file.details, where, name.substr(prefix.size()), text->value());
        else if (const auto* number = dynamic_cast<const Imf::FloatAttribute*>(&i.attribute()))
            setMetadata(file.field, file.details, where, name.substr(prefix.size()),
                        fmt::to_string(number->value()));
    }
}

bool hasChannel(const FileLocation& where, const Imf::Header& header, const DeepChannel& channel) {
    const Imf::Channel* found = header.channels().findChannel(channel.name);
    if (!found) return false;
    if (found->xSampling != 1 || found->ySampling != 1)
        throw badInput(where, "channel '{}' is subsampled", channel.name);
    if (found->type != Imf::FLOAT && (channel.exact || found->type != Imf::HALF))
        throw badInput(where, "channel '{}' must be of type float{}", channel.name,
                       channel.exact ? "" : " or half");
    return true;
}

/// The channels that the file has. Throws if a required one is missing.
template <std::size_t count>
std::vector<DeepChannel> present(const FileLocation& where, const Imf::Header& header,
                                 const std::array<DeepChannel, count>& channels) {
    std::vector<DeepChannel> list;
    for (const DeepChannel& channel : channels) {
        if (hasChannel(where, header, channel))
            list.push_back(channel);
        else if (channel.required)
            throw badInput(where, "has no channel '{}'", channel.name);
    }
    return list;
}

bool hasAny(const Imf::Header& header, const DeepPlane& plane) {
    return std::any_of(plane.channels.begin(), plane.channels.end(), [&](const DeepChannel& channel) {
        return header.channels().findChannel(channel.name) != nullptr;
    });
}

/// The groups of which the file has any channel: it needs all of theirs.
SamplePlanes planesIn(const Imf::Header& header) {
    SamplePlanes planes;
    for (const DeepPlane& plane : kDeepPlanes)
        if (plane.group && hasAny(header, plane)) planes.*plane.group = true;
    if (planes.shadows) planes.shading = true; // whose illumination they are rays of
    if (!planes.shading && hasAny(header, kNormalPlane)) planes.albedo = true; // normals need one of them
    return planes;
}

// ---------------------------------------------------------------- samples

std::size_t rowSamples(const LightField& field, int y) {
    const auto width = std::size_t(field.bounds.width()), first = std::size_t(y - field.bounds.y0) * width;
    return field.firstSample(first + width) - field.firstSample(first);
}

/// How many samples the pixels have, row by row.
std::vector<unsigned> readCounts(Imf::DeepScanLineInputFile& file, const Rect& bounds) {
    std::vector<unsigned> counts(bounds.area());
    file.setFrameBuffer(countBuffer(counts, bounds));
    file.readPixelSampleCounts(bounds.y0, bounds.y1 - 1);
    return counts;
}

/// Those that a field has room for.
std::vector<DeepPlane> planesOf(const LightField& field) {
    std::vector<DeepPlane> planes;
    std::copy_if(kDeepPlanes.begin(), kDeepPlanes.end(), std::back_inserter(planes),
                 [&](const DeepPlane& plane) { return !(field.*plane.values).empty(); });
    return planes;
}

/// What a file without these channels means.
void fillIn(LightField& field, bool alpha, bool slope) {
    for (LightFieldSample& s : field.samples) {
        if (!alpha) s.alpha = std::isinf(s.w) ? 0.f : 1.f;
        if (!slope) s.slope = field.slopeModel(s.w);
    }
}

void readSamples(const FileLocation& where, Imf::DeepScanLineInputFile& file, LightField& field,
                 Monitor& monitor) {
    const Imf::Header& header = file.header();
    const Rect& bounds = field.bounds;
    DeepRow row(field);
    const auto addAll = [&](const auto& channels, auto& samples) {
        row.add(present(where, header, channels), samples.data(), sizeof samples[0]);
    };
    addAll(kSampleChannels, field.samples);
    for (const DeepPlane& plane : planesOf(field)) addAll(plane.channels, field.*plane.values);

    monitor.beginStage("read", field.samples.size(), "samples");
    file.setFrameBuffer(row.frameBuffer());
    for (int y = bounds.y0; y < bounds.y1; ++y) {
        row.moveTo(y);
        file.readPixelSampleCounts(y, y); // OpenEXR forgets them with every new frame buffer
        row.checkCounts(where);
        file.readPixels(y, y);
        monitor.advance(rowSamples(field, y));
    }
    fillIn(field, header.channels().findChannel("A"), header.channels().findChannel("slope"));
    dropZeroMotion(field);
    monitor.endStage();
}

// ---------------------------------------------------------------- writing

Imf::Header makeHeader(const LightField& field, const FieldMetadata& details,
                       const std::vector<DeepChannel>& channels) {
    Imf::Header header(toBox(details.film), toBox(field.bounds));
    header.setType(Imf::DEEPSCANLINE);
    header.compression() = Imf::NO_COMPRESSION;
    for (const DeepChannel& channel : channels)
        header.channels().insert(channel.name, Imf::Channel(Imf::FLOAT));
    header.insert("slant:version", Imf::IntAttribute(kVersion));
    for (const SlopeConstant& constant : kSlopeConstants)
        header.insert(constant.name, Imf::FloatAttribute(field.slopeModel.*constant.value));
    if (const std::span<const float> map = numbersOf(field.lensMap); !map.empty())
        header.insert(kLensMap, Imf::FloatVectorAttribute({map.begin(), map.end()}));
    header.insert("slant:frame", Imf::Box2iAttribute(toBox(field.frame)));
    for (const auto& [name, value] : metadataOf(field, details)) {
        if (const auto* text = std::get_if<std::string>(&value))
            header.insert(name, Imf::StringAttribute(*text));
        else
            header.insert(name, Imf::FloatAttribute(std::get<float>(value)));
    }
    return header;
}

void encode(Imf::OStream& stream, const LightField& field, const FieldMetadata& details, Monitor& monitor) {
    std::vector<DeepChannel> channels(kSampleChannels.begin(), kSampleChannels.end());
    if (!hasOwnSlopes(field)) channels.pop_back();
    std::vector<DeepChannel> all = channels;

    DeepRow row(field);
    // OpenEXR only reads from them.
    row.add(channels, const_cast<LightFieldSample*>(field.samples.data()), sizeof(LightFieldSample));
    for (const DeepPlane& plane : planesOf(field)) {
        all.insert(all.end(), plane.channels.begin(), plane.channels.end());
        row.add(plane.channels, const_cast<glm::vec3*>((field.*plane.values).data()), sizeof(glm::vec3));
    }

    Imf::DeepScanLineOutputFile file(stream, makeHeader(field, details, all));
    file.setFrameBuffer(row.frameBuffer());
    for (int y = field.bounds.y0; y < field.bounds.y1; ++y) {
        row.moveTo(y);
        file.writePixels(1);
        monitor.advance(rowSamples(field, y));
    }
}

} // namespace

FieldFile readDeepExr(const std::string& path, Monitor& monitor) {
    const InputFile input(path);
    const FileLocation where{path};
    FieldFile result;
    try {
        const Imf::Header header = readHeader(input);
        LightField& field = result.field;
        field.bounds = toRect(header.dataWindow());
        result.details.film = toRect(header.displayWindow());
        const auto* frame = find<Imf::Box2iAttribute>(header, "slant:frame");
        field.frame = frame ? toRect(frame->value()) : result.details.film.intersect(field.bounds);
        readAttributes(where, header, header.channels().findChannel("slope"), result);
        field.samplesPerPixel = 1; // so far
        checkExtent(where, field, result.details);
        requireBytes(input, field.bounds.area(), 0);

        FileStream stream(input);
        Imf::DeepScanLineInputFile file(stream);
        takeSampleCounts(where, field, readCounts(file, field.bounds));
        requireBytes(input, field.bounds.area(), field.firstSample(field.bounds.area()));
        allocateSamples(field, planesIn(header));
        readSamples(where, file, field, monitor);
    } catch (const Iex::BaseExc& error) {
        throw badInput(where, "is a damaged OpenEXR file: {}", error.what());
    }
    return result;
}

void writeDeepExr(const std::string& path, const LightField& field, const FieldMetadata& details,
                  Monitor& monitor) {
    AtomicFile file(path);
    OutputStream stream(file, path);
    monitor.beginStage("write", field.samples.size(), "samples");
    try {
        encode(stream, field, details, monitor);
    } catch (const Iex::BaseExc& error) {
        stream.rethrow();
        throw Error(ErrorCode::resources, {path}, fmt::format("cannot encode as OpenEXR: {}", error.what()));
    }
    stream.rethrow();
    file.commit();
    monitor.endStage();
}

} // namespace slant

#include "scene/scene_files.h"

#include "base/monitor.h"
#include "base/read_file.h"
#include "scene/image_files.h"
#include "scene/latlong.h"
#include "scene/ply.h"

#include <filesystem>
#include <zlib.h>

namespace slant {
namespace {

bool isGzip(std::string_view bytes) {
    return bytes.starts_with("\x1f\x8b");
}

/// Owns zlib's state.
class Inflater {
public:
    Inflater() {
        constexpr int kGzipWindowBits = 16 + MAX_WBITS;
        if (inflateInit2(&stream, kGzipWindowBits) != Z_OK)
            throw Error(ErrorCode::resources, "no memory to unpack gzip data");
    }
    ~Inflater() { inflateEnd(&stream); }
    Inflater(const Inflater&) = delete;
    Inflater& operator=(const Inflater&) = delete;

    z_stream stream{};
};

/// One or several gzip members. The output grows with the actual data: sizes in headers are not trusted.
std::string unpack(const std::string& packed, const std::string& path, const FileLocation& where) {
    Inflater inflater;
    z_stream& stream = inflater.stream;
    std::string bytes;
    std::size_t consumed = 0, size = 0;
    while (isGzip(std::string_view(packed).substr(consumed))) {
        inflateReset(&stream);
        for (int status = Z_OK; status != Z_STREAM_END;) {
            bytes.resize(std::max({size + (std::size_t(1) << 16), packed.size(), 2 * size}));
            const auto in = uInt(std::min<std::size_t>(packed.size() - consumed, 1 << 30));
            const auto out = uInt(std::min<std::size_t>(bytes.size() - size, 1 << 30));
            stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data() + consumed));
            stream.avail_in = in;
            stream.next_out = reinterpret_cast<Bytef*>(bytes.data() + size);
            stream.avail_out = out;
            status = inflate(&stream, Z_NO_FLUSH);
            consumed += in - stream.avail_in;
            size += out - stream.avail_out;
            if (status != Z_OK && status != Z_STREAM_END)
                throw badInput(where, "{}: the gzip data is damaged or cut off", path);
            if (size > kMaxUnpackedBytes)
                throw badInput(where, "{} unpacks to more than the limit of {} bytes", path,
                               kMaxUnpackedBytes);
        }
    }
    bytes.resize(size);
    return bytes;
}

} // namespace

std::string readBytes(const std::string& path, const FileLocation& where) {
    if (path.find('\0') != std::string::npos) throw badInput(where, "a file name with a zero byte");
    std::string bytes;
    try {
        bytes = readFile(path);
    } catch (const Error& error) {
        if (where.file.empty()) throw;
        throw Error(error.code(), where, error.what());
    }
    return isGzip(bytes) ? unpack(bytes, path, where) : bytes;
}

std::string SceneFiles::resolve(const std::string& filename) const {
    return (std::filesystem::path(directory_) / filename).string();
}

int SceneFiles::image(const std::string& filename, ColourEncoding encoding, bool average,
                      const Position& where) {
    const std::string path = resolve(filename);
    const auto [entry, isNew] = images_.try_emplace({path, {encoding, average}}, -1);
    if (isNew) {
        Image image = readImageFile(path, encoding, average, where);
        entry->second = int(scene_.images.size());
        scene_.files.push_back(path);
        scene_.images.push_back(std::move(image));
    }
    return entry->second;
}

int SceneFiles::environment(const std::string& filename, const Position& where) {
    const std::string path = resolve(filename);
    if (const auto known = environments_.find(path); known != environments_.end()) return known->second;
    int index = image(filename, {}, false, where);
    const Image& file = scene_.images[std::size_t(index)];
    if (file.channelCount() != 3)
        throw badInput(where, "the image of an infinite light must have channels R, G and B");
    if (file.width() == 2 * file.height()) {
        scene_.images.push_back(octahedralOfLatLong(file));
        index = int(scene_.images.size()) - 1;
    } else if (file.width() != file.height()) {
        throw badInput(
            where,
            "the image of an infinite light must be square (equal-area octahedral), or twice as wide as "
            "high (latitude and longitude), but {} is {}x{}",
            filename, file.width(), file.height());
    }
    return environments_[path] = index;
}

ApertureShape SceneFiles::aperture(const std::string& text, const Position& where) const {
    ApertureShape shape = readAperture(text, directory_, where);
    if (shape.name == "image") scene_.files.push_back(resolve(text));
    return shape;
}

std::vector<int> SceneFiles::plyMeshes(const std::string& filename, const Position& where) {
    const std::string path = resolve(filename);
    if (const auto known = meshes_.find(path); known != meshes_.end()) return known->second;
    const std::string bytes = readBytes(path, where);
    PlyMeshes ply;
    try {
        ply = parsePly(bytes, path);
    } catch (const Error& error) {
        throw Error(error.code(), where, error.what());
    }
    scene_.files.push_back(path);
    if (ply.skippedFaces > 0)
        monitor_.warn(fmt::format("{}: {}: {} faces have neither 3 nor 4 vertices and are left out",
                                  FileLocation(where).text(), path, ply.skippedFaces));
    if (ply.lostNormals > 0)
        monitor_.warn(fmt::format("{}: {}: {} normals are not finite; the faces there keep their own",
                                  FileLocation(where).text(), path, ply.lostNormals));
    std::vector<int> indices;
    for (std::optional<Mesh>* mesh : {&ply.triangles, &ply.patches})
        if (*mesh) {
            indices.push_back(int(scene_.meshes.size()));
            scene_.meshes.push_back(std::move(**mesh));
        }
    return meshes_[path] = indices;
}

} // namespace slant

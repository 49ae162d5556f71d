// One small PLY file in every encoding.
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <fmt/format.h>
#include <stdexcept>
#include <string>
#include <vector>
#include <zlib.h>

namespace slant::test {

enum class PlyFormat { ascii, littleEndian, bigEndian };

/// Writes numbers of a PLY body in one format.
class PlyWriter {
public:
    explicit PlyWriter(PlyFormat format) : format_(format) {}

    template <typename T>
    void put(T value) {
        if (format_ == PlyFormat::ascii) {
            bytes += fmt::format("{} ", value);
            return;
        }
        auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
        if ((format_ == PlyFormat::bigEndian) == (std::endian::native == std::endian::little))
            std::reverse(raw.begin(), raw.end());
        bytes.append(raw.data(), raw.size());
    }

    std::string bytes;

private:
    PlyFormat format_;
};

/// Five vertices (x y z nx ny nz u v and a colour), three faces (triangle, quad, pentagon) with a flag, and
/// an element that nothing reads.
inline std::string samplePly(PlyFormat format) {
    const char* names[] = {"ascii", "binary_little_endian", "binary_big_endian"};
    PlyWriter body(format);
    body.bytes =
        fmt::format("ply\nformat {} 1.0\ncomment made for tests\nelement vertex 5\n"
                    "property float x\nproperty double y\nproperty float z\nproperty uchar red\n"
                    "property float nx\nproperty float ny\nproperty float nz\n"
                    "property float u\nproperty float v\n"
                    "element face 3\nproperty list uchar uint vertex_indices\nproperty short flag\n"
                    "element edge 2\nproperty list int8 float32 weights\nproperty int16 a\nend_header\n",
                    names[int(format)]);
    const float vertices[5][8] = {{0, 0, 0, 0, 0, 1, 0, 0},
                                  {1, 0, 0, 0, 0, 1, 1, 0},
                                  {1, 1, 0, 0, 0, 1, 1, 1},
                                  {0, 1, 0.25f, 0, 0, 1, 0, 1},
                                  {2, 0.5f, -1, 1, 0, 0, 0.5f, 0.75f}};
    for (const auto& v : vertices) {
        body.put(v[0]);
        body.put(double(v[1]));
        body.put(v[2]);
        body.put(std::uint8_t(200));
        for (int i = 3; i < 8; ++i) body.put(v[i]);
    }
    const std::vector<std::vector<std::uint32_t>> faces{{1, 4, 2}, {0, 1, 2, 3}, {0, 1, 4, 2, 3}};
    for (const auto& face : faces) {
        body.put(std::uint8_t(face.size()));
        for (const std::uint32_t index : face) body.put(index);
        body.put(std::int16_t(-1));
    }
    for (int edge = 0; edge < 2; ++edge) {
        body.put(std::int8_t(edge));
        for (int i = 0; i < edge; ++i) body.put(0.5f);
        body.put(std::int16_t(7));
    }
    return body.bytes;
}

/// One gzip member.
inline std::string gzipped(const std::string& bytes) {
    z_stream stream{};
    if (deflateInit2(&stream, 9, Z_DEFLATED, 16 + MAX_WBITS, 8, Z_DEFAULT_STRATEGY) != Z_OK)
        throw std::runtime_error("deflateInit2");
    std::string packed(deflateBound(&stream, bytes.size()), '\0');
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream.avail_in = uInt(bytes.size());
    stream.next_out = reinterpret_cast<Bytef*>(packed.data());
    stream.avail_out = uInt(packed.size());
    deflate(&stream, Z_FINISH);
    packed.resize(stream.total_out);
    deflateEnd(&stream);
    return packed;
}

} // namespace slant::test

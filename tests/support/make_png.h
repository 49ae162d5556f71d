// Small PNG files of every kind, written by hand (stored deflate blocks), independent of libpng.
#pragma once
#include <cstdint>
#include <string>

namespace slant::test {

inline std::string bigEndian(std::uint32_t value) {
    return {char(value >> 24), char(value >> 16), char(value >> 8), char(value)};
}

inline std::uint32_t crc32(const std::string& bytes) {
    std::uint32_t crc = ~0u;
    for (const char byte : bytes) {
        crc ^= std::uint8_t(byte);
        for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0u);
    }
    return ~crc;
}

inline std::string pngChunk(const std::string& type, const std::string& data) {
    return bigEndian(std::uint32_t(data.size())) + type + data + bigEndian(crc32(type + data));
}

/// One stored block: raw.size() < 65536.
inline std::string zlibStored(const std::string& raw) {
    std::uint32_t a = 1, b = 0;
    for (const char byte : raw) {
        a = (a + std::uint8_t(byte)) % 65521;
        b = (b + a) % 65521;
    }
    const auto size = std::uint16_t(raw.size()), inverse = std::uint16_t(~size);
    const std::string header = {
        '\x78', '\x01', '\x01', char(size & 255), char(size >> 8), char(inverse & 255), char(inverse >> 8)};
    return header + raw + bigEndian(b << 16 | a);
}

/// `rows` holds each row's bytes, with the filter byte 0 before each; `extra` are chunks before the pixels.
inline std::string makePng(std::uint32_t width, std::uint32_t height, int bitDepth, int colorType,
                           const std::string& rows, const std::string& extra = "") {
    const std::string header =
        bigEndian(width) + bigEndian(height) + char(bitDepth) + char(colorType) + std::string(3, '\0');
    return "\x89PNG\r\n\x1a\n" + pngChunk("IHDR", header) + extra + pngChunk("IDAT", zlibStored(rows)) +
           pngChunk("IEND", "");
}

} // namespace slant::test

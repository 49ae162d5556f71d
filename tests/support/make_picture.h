// Pictures of many kinds in memory, by stb_image_write.
#pragma once
#include <array>
#include <cstring>
#include <string>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wunused-function"
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

namespace slant::test {

inline constexpr int kPictureWidth = 16, kPictureHeight = 12;

/// Red grows to the right, green downwards, blue is in the middle.
inline std::array<float, 3> pictureColour(int x, int y) {
    return {float(x) / (kPictureWidth - 1), float(y) / (kPictureHeight - 1), 0.5f};
}

enum class PictureKind { jpeg, tga, hdr, pfm };

inline void appendTo(void* text, void* data, int size) {
    static_cast<std::string*>(text)->append(static_cast<const char*>(data), std::size_t(size));
}

inline std::string pictureBytes(PictureKind kind) {
    std::string bytes, texels;
    std::string floats;
    for (int y = 0; y < kPictureHeight; ++y)
        for (int x = 0; x < kPictureWidth; ++x)
            for (const float value : pictureColour(x, y)) {
                texels += char(value * 255 + 0.5f);
                floats.append(reinterpret_cast<const char*>(&value), sizeof value);
            }
    constexpr int w = kPictureWidth, h = kPictureHeight;
    const auto* values = reinterpret_cast<const float*>(floats.data());
    switch (kind) {
    case PictureKind::jpeg:
        stbi_write_jpg_to_func(appendTo, &bytes, w, h, 3, texels.data(), 100);
        break;
    case PictureKind::tga:
        stbi_write_tga_to_func(appendTo, &bytes, w, h, 3, texels.data());
        break;
    case PictureKind::hdr:
        stbi_write_hdr_to_func(appendTo, &bytes, w, h, 3, values);
        break;
    case PictureKind::pfm:
        bytes = "PF\n16 12\n-2.0\n"; // rows from the bottom, values times 2
        for (int y = h - 1; y >= 0; --y) bytes += floats.substr(std::size_t(y) * w * 12, std::size_t(w) * 12);
        break;
    }
    return bytes;
}

} // namespace slant::test

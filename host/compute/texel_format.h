// Formats of texel buffers: every device must support these, and shaders name them alike.
#pragma once
#include <cstdint>
#include <string_view>

namespace slant {

/// Named after the layout qualifiers of GLSL.
enum class TexelFormat { r32ui, rgba32ui, r32f, rgba32f, rgba16f };

inline constexpr TexelFormat kTexelFormats[] = {TexelFormat::r32ui, TexelFormat::rgba32ui, TexelFormat::r32f,
                                                TexelFormat::rgba32f, TexelFormat::rgba16f};

constexpr std::uint64_t texelBytes(TexelFormat format) {
    switch (format) {
    case TexelFormat::r32ui:
    case TexelFormat::r32f:
        return 4;
    case TexelFormat::rgba16f:
        return 8;
    default:
        return 16;
    }
}

constexpr bool holdsIntegers(TexelFormat format) {
    return format == TexelFormat::r32ui || format == TexelFormat::rgba32ui;
}

constexpr std::string_view formatName(TexelFormat format) {
    constexpr std::string_view names[] = {"r32ui", "rgba32ui", "r32f", "rgba32f", "rgba16f"};
    return names[int(format)];
}

} // namespace slant

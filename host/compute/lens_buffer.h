// A lens map on the device, and the constant of the shaders that use it.
#pragma once
#include "camera/lens_map.h"
#include "compute/buffer.h"

#include <array>

namespace slant {

/// kCompoundLens of resources/compound_lens.glsl.
inline std::array<std::uint32_t, 1> compoundLens(bool isCompound) {
    return {isCompound ? 1u : 0u};
}
inline std::array<std::uint32_t, 1> compoundLens(const LensMap& lens) {
    return compoundLens(!lens.empty());
}

inline Buffer lensBuffer(Device& device, const LensMap& lens) {
    Buffer buffer(device, TexelFormat::rgba32f, lens.texels().size());
    buffer.upload(lens.texels());
    return buffer;
}

} // namespace slant

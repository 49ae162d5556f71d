// A lens map and the motion of a field on the device, and the constants of the shaders that use them.
#pragma once
#include "camera/lens_map.h"
#include "compute/buffer.h"
#include "shared/motion.h"

#include <array>

namespace slant {

/// kCompoundLens of resources/compound_lens.glsl, kMoving of resources/moving.glsl.
inline std::array<std::uint32_t, 2> fieldConstants(bool isCompound, bool moves) {
    return {isCompound ? 1u : 0u, moves ? 1u : 0u};
}

inline Buffer lensBuffer(Device& device, const LensMap& lens) {
    Buffer buffer(device, TexelFormat::rgba32f, lens.texels().size());
    buffer.upload(lens.texels());
    return buffer;
}

/// As READ_MOTION_LAYOUT takes it.
inline Buffer motionBuffer(Device& device, const MotionLayout& layout) {
    static_assert(sizeof layout == kMotionTexels * sizeof(glm::vec4));
    Buffer buffer(device, TexelFormat::rgba32f, kMotionTexels);
    buffer.upload(std::span(&layout, 1));
    return buffer;
}

} // namespace slant

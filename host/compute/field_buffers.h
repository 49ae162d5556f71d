// What a field has beside its bins on the device: values of its samples, lens map and motion, and the
// constants of the shaders that use them.
#pragma once
#include "base/parallel.h"
#include "camera/lens_map.h"
#include "compute/buffer.h"
#include "shared/motion.h"

#include <algorithm>
#include <array>
#include <vector>

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

/// valueOf(i) of each of `count` samples, from all threads.
template <typename ValueOf>
Buffer sampleBuffer(Device& device, std::size_t count, const ValueOf& valueOf) {
    constexpr std::size_t kUploadValues = std::size_t(1) << 20; // at a time: 16 MiB
    Buffer buffer(device, TexelFormat::rgba32f, count);
    std::vector<glm::vec4> part(std::min(kUploadValues, count));
    for (std::size_t begin = 0; begin < count; begin += part.size()) {
        part.resize(std::min(kUploadValues, count - begin));
        parallelFor(0, part.size(), 1 << 15, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) part[i] = valueOf(begin + i);
        });
        buffer.upload(part, begin);
    }
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

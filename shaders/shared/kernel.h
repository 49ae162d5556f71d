// How the kernels of lib/ are written so that GLSL and C++ compilers take them. Not for headers: in C++ it
// brings GLSL's functions into the namespace.
//
// A kernel has KERNEL before it and IN or INOUT around the types of parameters that are more than a number.
// Values fetched in a hot loop are taken by IN too: C++ would copy them. Literals end in f, vectors are cut
// with vec2(v) and vec3(v) instead of swizzles, and structs are made by lists of initializers.
#ifndef SLANT_SHARED_KERNEL_H
#define SLANT_SHARED_KERNEL_H
#include "shared/types.h"

#ifdef __cplusplus
#include <bit>
#include <limits>

#define KERNEL inline
#define IN(T) const T&
#define INOUT(T) T&

namespace slant {
using glm::abs;
using glm::ceil;
using glm::clamp;
using glm::floor;
using glm::isinf;
using glm::isnan;
using glm::max;
using glm::min;
using glm::sqrt;

inline constexpr float kInfinity = std::numeric_limits<float>::infinity();

inline uint floatBitsToUint(float x) {
    return std::bit_cast<uint>(x);
}
inline float uintBitsToFloat(uint bits) {
    return std::bit_cast<float>(bits);
}

inline uint bitfieldReverse(uint x) {
    x = (x >> 16) | (x << 16);
    x = ((x & 0xff00ff00u) >> 8) | ((x & 0x00ff00ffu) << 8);
    x = ((x & 0xf0f0f0f0u) >> 4) | ((x & 0x0f0f0f0fu) << 4);
    x = ((x & 0xccccccccu) >> 2) | ((x & 0x33333333u) << 2);
    return ((x & 0xaaaaaaaau) >> 1) | ((x & 0x55555555u) << 1);
}
} // namespace slant
#else
#define KERNEL
#define IN(T) T
#define INOUT(T) inout T
#define kInfinity uintBitsToFloat(0x7f800000u)
#endif

#endif

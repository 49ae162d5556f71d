// An integer hash that GLSL has too (lib/hash.glsl).
#pragma once
#include "shared/types.h"

namespace slant {

inline uint hash(uint x) {
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    return x ^ (x >> 16);
}

} // namespace slant

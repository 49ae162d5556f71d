// An integer hash.
#ifndef SLANT_LIB_HASH_GLSL
#define SLANT_LIB_HASH_GLSL
#include "shared/kernel.h"

SLANT_SHARED_BEGIN

KERNEL uint hash(uint x) {
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    return x ^ (x >> 16);
}

SLANT_SHARED_END
#endif

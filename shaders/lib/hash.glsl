// An integer hash. As host/reconstruct/hash.h.
#ifndef SLANT_LIB_HASH_GLSL
#define SLANT_LIB_HASH_GLSL
uint hash(uint x) {
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    return x ^ (x >> 16);
}
#endif

// Floats as unsigned integers of the same order (negative ones have all bits flipped).
#ifndef SLANT_LIB_ORDERED_FLOAT_GLSL
#define SLANT_LIB_ORDERED_FLOAT_GLSL

uint orderedBits(float x) {
    const uint bits = floatBitsToUint(x);
    return (bits & 0x80000000u) != 0u ? ~bits : bits | 0x80000000u;
}

/// The bits of the float again.
uint floatBits(uint ordered) {
    return (ordered & 0x80000000u) != 0u ? ordered & 0x7fffffffu : ~ordered;
}
#endif

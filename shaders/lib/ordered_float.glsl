// Floats as unsigned integers of the same order (negative ones have all bits flipped). -0 becomes 0: which
// of the two were the least of some numbers would depend on the order of these.
#ifndef SLANT_LIB_ORDERED_FLOAT_GLSL
#define SLANT_LIB_ORDERED_FLOAT_GLSL

uint orderedBits(float x) {
    uint bits = floatBitsToUint(x);
    if (bits == 0x80000000u) bits = 0u;
    return (bits & 0x80000000u) != 0u ? ~bits : bits | 0x80000000u;
}

/// The bits of the float again.
uint floatBits(uint ordered) {
    return (ordered & 0x80000000u) != 0u ? ordered & 0x7fffffffu : ~ordered;
}
#endif

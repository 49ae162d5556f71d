// Binary search. Needs keyAt(uint), declared before the include.
#ifndef SLANT_LIB_LOWER_BOUND_GLSL
#define SLANT_LIB_LOWER_BOUND_GLSL

/// The first of `count` ascending keys from `first` on that is not below `value`; the place after them if
/// there is none.
uint lowerBound(uint value, uint first, uint count) {
    while (count > 0u) {
        const uint middle = count >> 1;
        const bool below = keyAt(first + middle) < value;
        first = below ? first + middle + 1u : first;
        count = below ? count - middle - 1u : middle;
    }
    return first;
}
#endif

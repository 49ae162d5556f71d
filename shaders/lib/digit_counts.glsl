// A counter for each digit of a radix sort, in registers: four counters of 8 bits per word. Comparisons
// choose the word, since indexing an array by a value would spill it to memory.
#ifndef SLANT_LIB_DIGIT_COUNTS_GLSL
#define SLANT_LIB_DIGIT_COUNTS_GLSL
#include "shared/radix.h"

const uint kDigitCountWords = kRadixDigits / 4u;

struct DigitCounts {
    uint words[kDigitCountWords];
};

DigitCounts noDigits() {
    DigitCounts counts;
    for (uint k = 0u; k < kDigitCountWords; ++k) counts.words[k] = 0u;
    return counts;
}

void addDigit(inout DigitCounts counts, uint digit) {
    const uint one = 1u << (digit % 4u * 8u);
    for (uint k = 0u; k < kDigitCountWords; ++k) counts.words[k] += digit / 4u == k ? one : 0u;
}

uint countOf(DigitCounts counts, uint digit) {
    uint word = 0u;
    for (uint k = 0u; k < kDigitCountWords; ++k) word = digit / 4u == k ? counts.words[k] : word;
    return word >> (digit % 4u * 8u) & 0xffu;
}
#endif

/* Stable radix sort of pairs: radix_count.comp, radix_scatter.comp. */
#ifndef SLANT_SHARED_RADIX_H
#define SLANT_SHARED_RADIX_H
#include "shared/types.h"

SLANT_SHARED_BEGIN

SLANT_SHARED_CONSTANT uint kRadixBits = 5u; /* of the key, sorted by one pass */
SLANT_SHARED_CONSTANT uint kRadixDigits = 1u << kRadixBits;
SLANT_SHARED_CONSTANT uint kRadixChunk = 240u; /* pairs that one invocation owns, at most 255 */

struct RadixPush {
    uint count;  /* pairs */
    uint chunks; /* count / kRadixChunk, rounded up */
    uint shift;  /* lowest bit of the digit */
    uint mask;   /* its bits: fewer than kRadixBits may be left of the key */
};

SLANT_SHARED_END
#endif

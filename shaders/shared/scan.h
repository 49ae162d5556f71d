/* Exclusive prefix sum: scan_reduce.comp, scan_apply.comp. */
#ifndef SLANT_SHARED_SCAN_H
#define SLANT_SHARED_SCAN_H
#include "shared/types.h"

SLANT_SHARED_BEGIN

/* Items that one invocation sums up. */
SLANT_SHARED_CONSTANT uint kScanChunk = 256u;

struct ScanPush {
    uint count;      /* items */
    uint hasOffsets; /* 0: there is one chunk, which begins at 0 */
};

SLANT_SHARED_END
#endif

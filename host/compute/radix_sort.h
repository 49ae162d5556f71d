// Stable radix sort of (key, value) pairs on the device; radixSort (base/sort.h) does the same on the CPU.
//
// It needs no atomics, so that every run writes the same words: each invocation counts the digits of its own
// chunk, a prefix sum over the counts, digit by digit, says where each chunk's pairs of each digit go, and
// each invocation moves its chunk there in order. (Satish, Harris, Garland: Designing Efficient Sorting
// Algorithms for Manycore GPUs, 2009, has the scheme with one chunk per workgroup.)
#pragma once
#include "compute/scan.h"

namespace slant {

/// Two r32ui buffers of equal size.
struct PairBuffers {
    PairBuffers(Device& device, std::uint64_t count)
        : keys(device, TexelFormat::r32ui, count), values(device, TexelFormat::r32ui, count) {}
    Buffer keys, values;
};

class RadixSort {
public:
    RadixSort(Device& device, std::uint64_t maxCount);

    /// Makes room for sorts of `maxCount` pairs; nothing recorded may be pending.
    void reserve(std::uint64_t maxCount);

    /// Records the sorting of the first `count` pairs by the lowest `keyBits` (0 to 32) bits of their keys,
    /// pairs of equal bits in the order in which they were. Works back and forth between the two buffers and
    /// returns the one that holds the result; the other holds nothing of use. Throws Error(usage) for counts
    /// over `maxCount` or a buffer's size.
    const PairBuffers& record(CommandList& commands, const PairBuffers& pairs, const PairBuffers& scratch,
                              std::uint64_t count, int keyBits) const;

private:
    Device& device_;
    Pass count_;
    Pass scatter_;
    Buffer histogram_;
    Scan scan_;
};

} // namespace slant

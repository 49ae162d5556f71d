// Prefix sums and stable sorting of words, in parallel. Their results follow from their definitions alone, so
// the compute passes of the same names (compute/scan.h, compute/radix_sort.h) give the same words.
#pragma once
#include <bit>
#include <cstdint>
#include <span>

namespace slant {

/// Each item becomes the sum, modulo 2^32, of those before it; returns the sum of all.
std::uint32_t exclusiveScan(std::span<std::uint32_t> items);

/// Sorts pairs by the lowest `keyBits` (0 to 32) bits of their keys; pairs of equal bits keep their order.
/// Both spans have the same length, below 2^32.
void radixSort(std::span<std::uint32_t> keys, std::span<std::uint32_t> values, int keyBits);

/// Bits that keys below `keyCount` need.
constexpr int keyBitsFor(std::uint32_t keyCount) {
    return keyCount < 2 ? 0 : std::bit_width(keyCount - 1);
}

} // namespace slant

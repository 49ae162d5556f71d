#include "base/sort.h"

#include "base/parallel.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace slant {
namespace {

constexpr std::size_t kBlock = 1 << 15; ///< items that one task takes
constexpr int kDigitBits = 8;
constexpr std::size_t kDigits = 1 << kDigitBits;

std::size_t blocksOf(std::size_t count) {
    return (count + kBlock - 1) / kBlock;
}

/// Calls body(block, first, last) for each block of [0, count).
template <typename Body>
void forBlocks(std::size_t count, const Body& body) {
    parallelFor(0, blocksOf(count), 1, [&](std::size_t firstBlock, std::size_t lastBlock) {
        for (std::size_t block = firstBlock; block < lastBlock; ++block)
            body(block, block * kBlock, std::min(count, (block + 1) * kBlock));
    });
}

std::uint32_t scanFrom(std::uint32_t sum, std::span<std::uint32_t> items) {
    for (std::uint32_t& item : items) sum += std::exchange(item, sum);
    return sum;
}

struct Pairs {
    std::span<std::uint32_t> keys, values;
};

/// One pass of the sort: places[block][digit] is where the block's next pair of that digit goes.
void sortByDigit(const Pairs& from, const Pairs& to, int shift, std::uint32_t mask) {
    std::vector<std::array<std::uint32_t, kDigits>> places(blocksOf(from.keys.size()));
    const auto digitOf = [&](std::uint32_t key) { return key >> shift & mask; };
    forBlocks(from.keys.size(), [&](std::size_t block, std::size_t first, std::size_t last) {
        places[block].fill(0);
        for (std::size_t i = first; i < last; ++i) ++places[block][digitOf(from.keys[i])];
    });
    std::uint32_t place = 0;
    for (std::size_t digit = 0; digit < kDigits; ++digit)
        for (auto& block : places) place += std::exchange(block[digit], place);
    forBlocks(from.keys.size(), [&](std::size_t block, std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const std::uint32_t target = places[block][digitOf(from.keys[i])]++;
            to.keys[target] = from.keys[i];
            to.values[target] = from.values[i];
        }
    });
}

} // namespace

std::uint32_t exclusiveScan(std::span<std::uint32_t> items) {
    std::vector<std::uint32_t> offsets(blocksOf(items.size()));
    forBlocks(items.size(), [&](std::size_t block, std::size_t first, std::size_t last) {
        std::uint32_t sum = 0;
        for (std::size_t i = first; i < last; ++i) sum += items[i];
        offsets[block] = sum;
    });
    const std::uint32_t total = scanFrom(0, offsets);
    forBlocks(items.size(), [&](std::size_t block, std::size_t first, std::size_t last) {
        scanFrom(offsets[block], items.subspan(first, last - first));
    });
    return total;
}

void radixSort(std::span<std::uint32_t> keys, std::span<std::uint32_t> values, int keyBits) {
    std::vector<std::uint32_t> scratchKeys(keys.size()), scratchValues(values.size());
    Pairs from{keys, values};
    Pairs to{scratchKeys, scratchValues};
    for (int shift = 0; shift < keyBits; shift += kDigitBits) {
        sortByDigit(from, to, shift, (1u << std::min(kDigitBits, keyBits - shift)) - 1);
        std::swap(from, to);
    }
    if (from.keys.data() == keys.data()) return;
    std::ranges::copy(from.keys, keys.begin());
    std::ranges::copy(from.values, values.begin());
}

} // namespace slant

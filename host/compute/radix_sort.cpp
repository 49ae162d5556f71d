#include "compute/radix_sort.h"

#include "base/error.h"
#include "shared/radix.h"

#include <algorithm>
#include <utility>

namespace slant {
namespace {

static_assert(kRadixChunk < 256, "the shaders count in bytes");

std::uint64_t chunksOf(std::uint64_t count) {
    return (count + kRadixChunk - 1) / kRadixChunk;
}

} // namespace

RadixSort::RadixSort(Device& device, std::uint64_t maxCount)
    : device_(device), count_(device, "radix_count"), scatter_(device, "radix_scatter"),
      histogram_(device, TexelFormat::r32ui, chunksOf(maxCount) * kRadixDigits),
      scan_(device, histogram_.texels()) {}

void RadixSort::reserve(std::uint64_t maxCount) {
    const std::uint64_t words = chunksOf(maxCount) * kRadixDigits;
    if (words <= histogram_.texels()) return;
    histogram_ = Buffer(device_, TexelFormat::r32ui, words);
    scan_.reserve(words);
}

const PairBuffers& RadixSort::record(CommandList& commands, const PairBuffers& pairs,
                                     const PairBuffers& scratch, std::uint64_t count, int keyBits) const {
    const std::uint64_t chunks = chunksOf(count);
    const std::uint64_t fits = std::min(
        {pairs.keys.texels(), pairs.values.texels(), scratch.keys.texels(), scratch.values.texels()});
    if (count > fits || chunks * kRadixDigits > histogram_.texels())
        throw Error(ErrorCode::usage, fmt::format("sort of {} pairs: made for {}, the buffers hold {}", count,
                                                  histogram_.texels() / kRadixDigits * kRadixChunk, fits));
    const PairBuffers* from = &pairs;
    const PairBuffers* to = &scratch;
    for (int shift = 0; shift < keyBits; shift += int(kRadixBits)) {
        const int digitBits = std::min(int(kRadixBits), keyBits - shift);
        const RadixPush push{uint(count), uint(chunks), uint(shift), (1u << digitBits) - 1};
        commands.dispatch(count_, {from->keys, histogram_}, push, count_.gridFor(chunks));
        scan_.record(commands, histogram_, chunks * kRadixDigits);
        commands.dispatch(scatter_, {from->keys, from->values, histogram_, to->keys, to->values}, push,
                          scatter_.gridFor(chunks));
        std::swap(from, to);
    }
    return *from;
}

} // namespace slant

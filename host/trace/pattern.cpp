#include "trace/pattern.h"

#include "base/error.h"

namespace slant {
namespace {

/// Pixels of one tile share a sequence: 2^14 pixels with up to 2^18 samples fill the 32 bits of an index.
constexpr int kTileBits = 7;

/// Bits of x at even positions.
std::uint32_t spread(std::uint32_t x) {
    x = (x | (x << 4)) & 0x0f0fu;
    x = (x | (x << 2)) & 0x3333u;
    return (x | (x << 1)) & 0x5555u;
}

} // namespace

Pattern::Pattern(int samplesPerPixel, std::uint64_t seed)
    : samplesPerPixel_(std::uint32_t(samplesPerPixel)),
      seed_(hashWords(std::uint32_t(seed), std::uint32_t(seed >> 32))) {
    if (samplesPerPixel < 1 || samplesPerPixel > kMaxSamplesPerPixel)
        throw Error(ErrorCode::usage, fmt::format("{} samples per pixel: must be between 1 and {}",
                                                  samplesPerPixel, kMaxSamplesPerPixel));
}

PatternPixel Pattern::pixel(int x, int y) const {
    constexpr int kMask = (1 << kTileBits) - 1;
    std::uint32_t tileSeed =
        hashWords(hashWords(seed_, std::uint32_t(x >> kTileBits)), std::uint32_t(y >> kTileBits));
    std::uint32_t morton = spread(std::uint32_t(x & kMask)) | (spread(std::uint32_t(y & kMask)) << 1);
    // Shuffled hierarchically, so that blocks of the curve stay blocks.
    constexpr int kUnusedBits = 32 - 2 * kTileBits;
    std::uint32_t rank =
        reverseBits(scrambleReversed(reverseBits(morton << kUnusedBits), tileSeed)) >> kUnusedBits;
    return {rank * samplesPerPixel_, tileSeed};
}

} // namespace slant

// Where the samples of the light field lie: low-discrepancy points over pixel, lens and shutter, and further
// dimensions for shading. Every value is computed from (pixel, sample index, seed) alone.
//
// Samples of a pixel are consecutive points of one long (0,2)-sequence; pixels take their turns along a
// shuffled Morton curve, so that neighbouring pixels complement each other in every pair of dimensions (after
// Ahmed and Wonka, "Screen-Space Blue-Noise Diffusion of Monte Carlo Sampling Error via Hierarchical Ordering
// of Pixels", 2020; with runs of any length instead of powers of two, so that any number of samples per pixel
// works). Pairs of dimensions are Sobol' points after Owen scrambling by hashes (Burley, "Practical
// Hash-based Owen Scrambling", 2020; hash constants by N. Vegdahl, 2021).
#pragma once
#include <bit>
#include <cstdint>
#include <glm/glm.hpp>

namespace slant {

/// Bits in opposite order.
constexpr std::uint32_t reverseBits(std::uint32_t x) {
    x = (x >> 16) | (x << 16);
    x = ((x & 0xff00ff00u) >> 8) | ((x & 0x00ff00ffu) << 8);
    x = ((x & 0xf0f0f0f0u) >> 4) | ((x & 0x0f0f0f0fu) << 4);
    x = ((x & 0xccccccccu) >> 2) | ((x & 0x33333333u) << 2);
    return ((x & 0xaaaaaaaau) >> 1) | ((x & 0x55555555u) << 1);
}

/// A well-mixed 32-bit hash of two words (lowbias32 by C. Wellons).
constexpr std::uint32_t hashWords(std::uint32_t a, std::uint32_t b) {
    std::uint32_t x = a ^ (b * 0x9e3779b9u + 0x7f4a7c15u);
    x = (x ^ (x >> 16)) * 0x7feb352du;
    x = (x ^ (x >> 15)) * 0x846ca68bu;
    return x ^ (x >> 16);
}

/// The same of the bits of three numbers.
inline std::uint32_t hashVector(glm::vec3 v) {
    const auto bits = [](float x) { return std::bit_cast<std::uint32_t>(x); };
    return hashWords(hashWords(bits(v.x), bits(v.y)), bits(v.z));
}

/// Owen scrambling of a number whose bits are given in opposite order, left in that order: each bit is
/// flipped or not by a hash of the seed and of the bits below it.
constexpr std::uint32_t scrambleReversed(std::uint32_t x, std::uint32_t seed) {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}

/// Second dimension of the Sobol' sequence, bits in opposite order: its matrix is Pascal's triangle modulo 2,
/// a sum over supersets of bit positions.
constexpr std::uint32_t sobolSecondReversed(std::uint32_t index) {
    std::uint32_t x = index;
    x ^= (x >> 1) & 0x55555555u;
    x ^= (x >> 2) & 0x33333333u;
    x ^= (x >> 4) & 0x0f0f0f0fu;
    x ^= (x >> 8) & 0x00ff00ffu;
    return x ^ ((x >> 16) & 0x0000ffffu);
}

/// The top 24 bits as a number in [0, 1).
constexpr float unitFloat(std::uint32_t x) {
    return float(x >> 8) * 0x1p-24f;
}

/// Point `index` of the scrambled, shuffled (0,2)-sequence that `seed` names; in [0, 1)^2.
inline glm::vec2 scrambledPair(std::uint32_t index, std::uint32_t seed) {
    std::uint32_t shuffled = reverseBits(scrambleReversed(reverseBits(index), seed));
    return {unitFloat(reverseBits(scrambleReversed(shuffled, hashWords(seed, 1)))),
            unitFloat(reverseBits(scrambleReversed(sobolSecondReversed(shuffled), hashWords(seed, 2))))};
}

/// Random numbers for shading one sample, in the order they are asked for: stratified within a pixel and over
/// its neighbours, as long as all paths ask in the same order.
class ShadingSampler {
public:
    ShadingSampler() = default;
    ShadingSampler(std::uint32_t index, std::uint32_t seed) : index_(index), seed_(seed) {}

    float next1D() { return next2D().x; }
    glm::vec2 next2D() { return scrambledPair(index_, hashWords(seed_, ++dimension_)); }

private:
    std::uint32_t index_ = 0, seed_ = 0, dimension_ = 0;
};

/// One sample's place: x, y inside its pixel, (a, b) on the unit square that maps to the lens, t in the
/// shutter; all in [0, 1).
struct PatternPoint {
    float x, y, a, b, t;
};

/// The place of one pixel along the curve.
struct PatternPixel {
    std::uint32_t firstIndex, seed;
};

class Pattern {
public:
    static constexpr int kMaxSamplesPerPixel = 1 << 18;

    /// Throws Error(usage) unless 1 <= samplesPerPixel <= kMaxSamplesPerPixel.
    Pattern(int samplesPerPixel, std::uint64_t seed);

    int samplesPerPixel() const { return int(samplesPerPixel_); }
    /// Any pixel, negative ones too.
    PatternPixel pixel(int x, int y) const;
    /// 0 <= sample < samplesPerPixel.
    PatternPoint point(PatternPixel pixel, int sample) const {
        std::uint32_t index = pixel.firstIndex + std::uint32_t(sample);
        glm::vec2 xy = scrambledPair(index, hashWords(pixel.seed, 0x10001u));
        glm::vec2 ab = scrambledPair(index, hashWords(pixel.seed, 0x10002u));
        std::uint32_t shuffled =
            reverseBits(scrambleReversed(reverseBits(index), hashWords(pixel.seed, 0x10003u)));
        float t = unitFloat(reverseBits(scrambleReversed(shuffled, hashWords(pixel.seed, 0x10004u))));
        return {xy.x, xy.y, ab.x, ab.y, t};
    }
    ShadingSampler shading(PatternPixel pixel, int sample) const {
        return {pixel.firstIndex + std::uint32_t(sample), pixel.seed};
    }

private:
    std::uint32_t samplesPerPixel_, seed_;
};

} // namespace slant

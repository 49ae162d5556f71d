// Kernels that are numbers alone: the hash, the scramble of outputs, position codes, weights of the pixel
// filter, polar coordinates, ordered bits and binary search.
#include "lib/disc.glsl"
#include "lib/hash.glsl"
#include "lib/output.glsl"
#include "reconstruct/filter_table.h"
#include "reconstruct/output_pattern.h"
#include "support/synthetic.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <set>

namespace slant {
namespace {

/// Step by step back: both factors are odd, and so have inverses modulo 2^32.
uint unhash(uint x) {
    x ^= x >> 16;
    x *= 0x43021123u;
    x ^= x >> 15 ^ x >> 30;
    x *= 0x1d69e2a5u;
    return x ^ x >> 16;
}

TEST(Hash, isAPermutation) {
    synthetic::Random random(1);
    for (uint i = 0; i < 200000; ++i)
        for (const uint x : {i, ~i, i << 14, random.bits()}) ASSERT_EQ(unhash(hash(x)), x);
}

TEST(Hash, valuesAreThoseOfTheBeginning) {
    EXPECT_EQ(hash(0), 0u);
    EXPECT_EQ(hash(1), 0x688990c0u);
    EXPECT_EQ(hash(2), 0xd1132181u);
    EXPECT_EQ(hash(0x80000000u), 0xcc4b4124u);
    EXPECT_EQ(hash(0xffffffffu), 0x6768824au);
    EXPECT_EQ(hash(0x12345678u), 0xf5e71c96u);
}

/// Each bit of the argument flips each bit of the value in half of all cases. 20,000 draws have a standard
/// deviation of 0.0035.
TEST(Hash, anyBitChangesHalfOfTheBits) {
    constexpr int kDraws = 20000;
    std::vector<int> turned(32 * 32);
    synthetic::Random random(2);
    for (int i = 0; i < kDraws; ++i) {
        const uint x = random.bits(), value = hash(x);
        for (uint bit = 0; bit < 32; ++bit) {
            const uint change = value ^ hash(x ^ 1u << bit);
            for (uint out = 0; out < 32; ++out) turned[bit * 32 + out] += change >> out & 1u;
        }
    }
    for (const int count : turned) EXPECT_NEAR(double(count) / kDraws, 0.5, 0.02);
}

/// Of the first k bits the scramble is a permutation, whatever bits follow.
TEST(OwenScramble, permutesTheStrataOfEveryPowerOfTwo) {
    synthetic::Random random(3);
    for (int round = 0; round < 50; ++round) {
        const uint seed = round == 0 ? 0u : random.bits();
        for (uint bits = 1; bits <= 10; ++bits) {
            std::set<uint> strata;
            for (uint i = 0; i < 1u << bits; ++i) {
                const uint x = i << (32 - bits);
                const uint stratum = owenScramble(bitfieldReverse(x), seed) >> (32 - bits);
                strata.insert(stratum);
                const uint rest = random.bits() >> bits;
                ASSERT_EQ(owenScramble(bitfieldReverse(x | rest), seed) >> (32 - bits), stratum);
            }
            ASSERT_EQ(strata.size(), 1u << bits);
        }
    }
}

/// Over many seeds, a stratum ends up anywhere.
TEST(OwenScramble, seedsSpreadAStratumEvenly) {
    std::vector<int> counts(16);
    for (uint seed = 0; seed < 16000; ++seed) ++counts[owenScramble(0x5u, hash(seed)) >> 28];
    for (const int count : counts) EXPECT_NEAR(count, 1000, 150);
}

TEST(PositionCodes, areThePlacesInThePixel) {
    synthetic::Random random(4);
    for (int i = 0; i < 20000; ++i) {
        const ivec2 pixel(int(random.bits() % 1000) - 500, int(random.bits() % 1000) - 500);
        const uvec4 entry(random.bits(), random.bits(), random.bits(), 0);
        const Output o = placed(pixel, entry, random.bits());
        const int code = int(o.positionCode);
        ASSERT_EQ(float(code), o.positionCode);
        ASSERT_GE(code, 0);
        ASSERT_LT(code, kSubpixels * kSubpixels);
        // 9 bits of a pixel, 13 of its part: exact.
        ASSERT_EQ(double(o.xy.x), pixel.x + (code / kSubpixels + 0.5) / kSubpixels);
        ASSERT_EQ(double(o.xy.y), pixel.y + (code % kSubpixels + 0.5) / kSubpixels);
        ASSERT_EQ(o.uv, vec2(0));
        ASSERT_FALSE(o.onSceneSide);
    }
    EXPECT_EQ(kWholePixel, float(kSubpixels * kSubpixels)) << "is none of them";
}

struct FilmKernels {
    const FilterTable& filter;

    float filterWeightAt(int i) const { return filter.weights[std::size_t(i)]; }
#include "lib/film.glsl"
};

TEST(FilmWeights, areTheFilterAtTheDistanceOfPixelAndSample) {
    const std::vector<PixelFilter> filters = {{FilterKind::box, {0.5f, 1.3f}},
                                              {FilterKind::triangle, {2, 0.25f}},
                                              {FilterKind::gaussian, {1.5f, 2.2f}},
                                              {FilterKind::mitchell, {2, 3}},
                                              {FilterKind::sinc, {4, 3.01f}}};
    for (const PixelFilter& filter : filters) {
        const FilterTable table = makeFilterTable(filter);
        FilmKernels kernels{table};
        for (int axis = 0; axis < 2; ++axis) {
            const double radius = filter.radius[axis];
            for (int offset = -table.reach[axis] - 1; offset <= table.reach[axis] + 1; ++offset)
                for (int q = 0; q < kSubpixels; ++q) {
                    const double distance = std::abs(offset + (q + 0.5) / kSubpixels - 0.5); // exact
                    const float got =
                        kernels.axisWeight(axis == 0 ? 0 : table.length.x, table.length[axis], offset, q);
                    ASSERT_EQ(got, float(evaluateFilterAxis(filter, radius, distance)))
                        << int(filter.kind) << ", " << offset << ", " << q;
                }
        }
    }
    const vec4 sample = FilmKernels{makeFilterTable(filters[0])}.weighted(vec4(1, 2, 4, 99), 0.25f);
    EXPECT_EQ(sample, vec4(0.25f, 0.5f, 1, 0.25f));
}

TEST(Polar, isAngleAndDistanceOfThePlaceOnTheDisc) {
    constexpr int kSteps = 300;
    for (int j = 0; j <= kSteps; ++j)
        for (int i = 0; i <= kSteps; ++i) {
            const vec2 square(2 * float(i) / kSteps - 1, 2 * float(j) / kSteps - 1);
            const Polar polar = polarOf(square);
            ASSERT_EQ(polar.distance, std::max(std::abs(square.x), std::abs(square.y)));
            if (polar.distance == 0) continue;
            const vec2 disc = concentricDisc(square);
            double turn = std::atan2(double(disc.y), double(disc.x)) / (2 * std::numbers::pi);
            turn -= std::floor(turn);
            const double apart = std::abs(turn - double(polar.turn));
            ASSERT_LT(std::min(apart, 1 - apart), 1e-6) << i << ' ' << j;
            ASSERT_GE(polar.turn, 0);
            ASSERT_LT(polar.turn, 1);
            const vec2 back = squareOf(polar);
            ASSERT_NEAR(back.x, square.x, 2e-6);
            ASSERT_NEAR(back.y, square.y, 2e-6);
        }
}

struct OrderedKernels {
#include "lib/ordered_float.glsl"
};

TEST(OrderedBits, haveTheOrderOfTheirFloats) {
    OrderedKernels kernels;
    std::vector<float> values = {-kInfinity, -3e38f, -1, -1e-40f, 0, 1e-40f, 1e-3f, 1, 2, 3e38f, kInfinity};
    synthetic::Random random(5);
    for (int i = 0; i < 20000; ++i) {
        const float value = uintBitsToFloat(random.bits());
        if (!std::isnan(value)) values.push_back(value);
    }
    std::sort(values.begin(), values.end());
    EXPECT_EQ(kernels.orderedBits(-0.f), kernels.orderedBits(0.f));
    for (std::size_t i = 0; i < values.size(); ++i) {
        const uint bits = kernels.orderedBits(values[i]);
        ASSERT_EQ(kernels.floatBits(bits), floatBitsToUint(values[i]));
        if (i > 0 && values[i - 1] < values[i]) {
            ASSERT_LT(kernels.orderedBits(values[i - 1]), bits);
        }
    }
}

struct SearchKernels {
    const std::vector<uint>& keys;

    uint keyAt(uint i) const { return keys[i]; }
#include "lib/lower_bound.glsl"
};

TEST(LowerBound, isThatOfTheStandardLibrary) {
    synthetic::Random random(6);
    for (int i = 0; i < 3000; ++i) {
        std::vector<uint> keys(random.bits() % 40);
        for (uint& key : keys) key = random.bits() % 30;
        const uint first = keys.empty() ? 0 : random.bits() % uint(keys.size());
        std::sort(keys.begin() + first, keys.end());
        for (uint value = 0; value < 32; ++value) {
            const auto expected = std::lower_bound(keys.begin() + first, keys.end(), value) - keys.begin();
            ASSERT_EQ(SearchKernels{keys}.lowerBound(value, first, uint(keys.size()) - first),
                      uint(expected));
        }
    }
}

} // namespace
} // namespace slant

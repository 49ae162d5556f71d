// Prefix sum and radix sort: the device against the CPU, and both against the standard library.
#include "base/sort.h"
#include "compute/radix_sort.h"
#include "support/vulkan_fixture.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <random>

namespace slant {
namespace {

using Words = std::vector<std::uint32_t>;

constexpr std::size_t kSizes[] = {0,   1,   2,   63,   64,    65,     239,         240,
                                  241, 255, 256, 1000, 65537, 262145, 1000000 + 13};

Words randomWords(std::size_t count, std::uint32_t seed) {
    std::mt19937 random(seed);
    Words words(count);
    std::ranges::generate(words, std::ref(random));
    return words;
}

Words download(const Buffer& buffer, std::size_t count) {
    Words words(count);
    buffer.download(words);
    return words;
}

class ScanTest : public test::VulkanTest {
protected:
    static Words scanOnDevice(const Words& items) {
        Buffer buffer(device(), TexelFormat::r32ui, items.size());
        buffer.upload(items);
        const Scan scan(device(), items.size());
        CommandList commands(device());
        scan.record(commands, buffer, items.size());
        commands.run();
        return download(buffer, items.size());
    }
};

TEST_F(ScanTest, equalsTheStandardLibraryAtAnySize) {
    for (const std::size_t size : kSizes) {
        const Words items = randomWords(size, 1); // sums wrap around
        Words expected(size);
        std::exclusive_scan(items.begin(), items.end(), expected.begin(), 0u);
        Words onCpu = items;
        EXPECT_EQ(exclusiveScan(onCpu), std::accumulate(items.begin(), items.end(), 0u)) << size;
        EXPECT_TRUE(onCpu == expected) << size;
        EXPECT_TRUE(scanOnDevice(items) == expected) << size;
    }
}

TEST_F(ScanTest, leavesWhatLiesBehindTheCount) {
    const Words items(1000, 3);
    Buffer buffer(device(), TexelFormat::r32ui, items.size());
    buffer.upload(items);
    const Scan scan(device(), 1000);
    CommandList commands(device());
    scan.record(commands, buffer, 500);
    commands.run();
    const Words result = download(buffer, items.size());
    EXPECT_EQ(result[499], 3u * 499);
    EXPECT_TRUE(std::all_of(result.begin() + 500, result.end(), [](std::uint32_t w) { return w == 3; }));
}

TEST_F(ScanTest, refusesCountsThatDoNotFit) {
    const Buffer buffer(device(), TexelFormat::r32ui, 100);
    const Scan scan(device(), 200);
    CommandList commands(device());
    EXPECT_THROW(scan.record(commands, buffer, 101), Error);
    EXPECT_THROW(scan.record(commands, buffer, 201), Error);
}

struct PairWords {
    Words keys, values;
    bool operator==(const PairWords&) const = default;
};

/// By definition: the order of std::stable_sort by the masked keys.
PairWords sortedByDefinition(const PairWords& pairs, int keyBits) {
    const std::uint32_t mask = keyBits == 32 ? ~0u : (1u << keyBits) - 1;
    std::vector<std::uint32_t> order(pairs.keys.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::stable_sort(order, {}, [&](std::uint32_t i) { return pairs.keys[i] & mask; });
    PairWords result;
    for (const std::uint32_t i : order) {
        result.keys.push_back(pairs.keys[i]);
        result.values.push_back(pairs.values[i]);
    }
    return result;
}

PairWords sortedOnCpu(PairWords pairs, int keyBits) {
    radixSort(pairs.keys, pairs.values, keyBits);
    return pairs;
}

class SortTest : public test::VulkanTest {
protected:
    static PairWords sortedOnDevice(const PairWords& pairs, int keyBits) {
        const std::size_t count = pairs.keys.size();
        PairBuffers buffers(device(), count);
        const PairBuffers scratch(device(), count);
        buffers.keys.upload(pairs.keys);
        buffers.values.upload(pairs.values);
        const RadixSort sort(device(), count);
        CommandList commands(device());
        const PairBuffers& sorted = sort.record(commands, buffers, scratch, count, keyBits);
        commands.run();
        return {download(sorted.keys, count), download(sorted.values, count)};
    }

    static void expectSorted(const Words& keys, int keyBits, const char* what) {
        PairWords pairs{keys, Words(keys.size())};
        std::iota(pairs.values.begin(), pairs.values.end(), 7u);
        const PairWords expected = sortedByDefinition(pairs, keyBits);
        EXPECT_TRUE(sortedOnCpu(pairs, keyBits) == expected) << what << ", CPU, " << keys.size() << " pairs";
        EXPECT_TRUE(sortedOnDevice(pairs, keyBits) == expected)
            << what << ", device, " << keys.size() << " pairs";
    }
};

TEST_F(SortTest, equalsAStableSortAtAnySize) {
    for (const std::size_t size : kSizes) expectSorted(randomWords(size, 2), 17, "random");
}

TEST_F(SortTest, sortsByAsManyBitsAsAskedFor) {
    const Words keys = randomWords(3001, 3);
    for (const int bits : {0, 1, 4, 5, 6, 8, 10, 31, 32}) expectSorted(keys, bits, "random");
}

TEST_F(SortTest, standsAdversarialKeys) {
    constexpr std::size_t kCount = 70001;
    Words descending(kCount), sawtooth(kCount);
    for (std::size_t i = 0; i < kCount; ++i) {
        descending[i] = std::uint32_t(kCount - i);
        sawtooth[i] = std::uint32_t(i % 241);
    }
    Words oneElsewhere(kCount, 5);
    oneElsewhere[kCount / 2] = 3;
    expectSorted(Words(kCount, 0), 17, "all zero");
    expectSorted(Words(kCount, ~0u), 32, "all ones");
    expectSorted(descending, 17, "descending");
    expectSorted(sawtooth, 8, "sawtooth");
    expectSorted(oneElsewhere, 3, "one bucket and one elsewhere");
}

TEST_F(SortTest, givesTheSameWordsTwice) {
    const PairWords pairs{randomWords(100003, 4), randomWords(100003, 5)};
    EXPECT_TRUE(sortedOnDevice(pairs, 12) == sortedOnDevice(pairs, 12));
}

TEST_F(SortTest, refusesCountsThatDoNotFit) {
    const PairBuffers pairs(device(), 1000), scratch(device(), 999);
    const RadixSort sort(device(), 1000);
    CommandList commands(device());
    EXPECT_THROW(sort.record(commands, pairs, scratch, 1000, 8), Error);
    EXPECT_THROW(sort.record(commands, pairs, pairs, 2000, 8), Error);
}

TEST(KeyBits, areEnoughForTheLargestKey) {
    EXPECT_EQ(keyBitsFor(0), 0);
    EXPECT_EQ(keyBitsFor(1), 0);
    EXPECT_EQ(keyBitsFor(2), 1);
    EXPECT_EQ(keyBitsFor(256), 8);
    EXPECT_EQ(keyBitsFor(257), 9);
    EXPECT_EQ(keyBitsFor(~0u), 32);
}

} // namespace
} // namespace slant

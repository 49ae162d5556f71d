// That a comparison of intermediates can fail, and then says where.
#include "reconstruct/intermediates.h"

#include <gtest/gtest.h>
#include <numeric>

namespace slant {
namespace {

using Made = std::vector<std::pair<std::string, std::vector<uint>>>;

Made threeIntermediates() {
    std::vector<uint> words(5000);
    std::iota(words.begin(), words.end(), 17u);
    return {{"bin", words}, {"empty", {}}, {"dense", words}};
}

void run(const Made& stages, IntermediateObserver& observer) {
    for (const auto& [name, words] : stages) observer.receive(name, words);
}

std::optional<IntermediateDifference> compare(const Made& expected, const Made& got) {
    IntermediateRecorder recorder;
    run(expected, recorder);
    IntermediateComparer comparer(recorder);
    run(got, comparer);
    return comparer.difference();
}

TEST(Intermediates, equalRunsHaveNoDifference) {
    EXPECT_FALSE(compare(threeIntermediates(), threeIntermediates()));
    EXPECT_FALSE(compare({}, {}));
}

TEST(Intermediates, oneBitIsFoundWhereverItIs) {
    for (const std::size_t word : {0u, 1023u, 1024u, 3333u, 4999u})
        for (const uint bit : {0u, 31u}) {
            Made changed = threeIntermediates();
            changed[2].second[word] ^= 1u << bit;
            const auto difference = compare(threeIntermediates(), changed);
            ASSERT_TRUE(difference) << word;
            EXPECT_EQ(difference->index, 2u);
            EXPECT_EQ(difference->name, "dense");
            EXPECT_EQ(difference->firstWord, word / 1024 * 1024);
            EXPECT_EQ(difference->expectedWords, 5000u);
            EXPECT_EQ(difference->got.at(word - difference->firstWord), changed[2].second[word]);

            IntermediateReader reader(difference->index, difference->firstWord, difference->got.size());
            run(threeIntermediates(), reader);
            ASSERT_EQ(reader.words().size(), difference->got.size());
            for (std::size_t i = 0; i < reader.words().size(); ++i)
                EXPECT_EQ(reader.words()[i] == difference->got[i], difference->firstWord + i != word);
        }
}

TEST(Intermediates, exchangedWordsAreADifference) {
    Made changed = threeIntermediates();
    std::swap(changed[0].second[7], changed[0].second[8]);
    EXPECT_TRUE(compare(threeIntermediates(), changed));
}

TEST(Intermediates, theFirstDifferenceIsTold) {
    Made changed = threeIntermediates();
    changed[2].second[0] ^= 1;
    changed[0].second[4000] ^= 1;
    changed[0].second[2000] ^= 1;
    const auto difference = compare(threeIntermediates(), changed);
    ASSERT_TRUE(difference);
    EXPECT_EQ(difference->name, "bin");
    EXPECT_EQ(difference->firstWord, 1024u);
}

TEST(Intermediates, missingExtraAndRenamedStagesAreDifferences) {
    Made shorter = threeIntermediates();
    shorter.pop_back();
    const auto missing = compare(threeIntermediates(), shorter);
    ASSERT_TRUE(missing);
    EXPECT_EQ(missing->index, 2u);
    EXPECT_EQ(missing->name, "dense");
    EXPECT_EQ(missing->expectedWords, 5000u);
    EXPECT_EQ(missing->gotWords, 0u);

    const auto extra = compare(shorter, threeIntermediates());
    ASSERT_TRUE(extra);
    EXPECT_EQ(extra->index, 2u);
    EXPECT_EQ(extra->expectedWords, 0u);
    EXPECT_EQ(extra->gotWords, 5000u);

    Made renamed = threeIntermediates();
    renamed[1].first = "lists";
    const auto other = compare(threeIntermediates(), renamed);
    ASSERT_TRUE(other);
    EXPECT_EQ(other->index, 1u);
}

TEST(Intermediates, differentSizesAreADifference) {
    for (const std::size_t size : {0u, 4096u, 4999u, 5001u}) {
        Made changed = threeIntermediates();
        changed[0].second.resize(size, 5016);
        const auto difference = compare(threeIntermediates(), changed);
        ASSERT_TRUE(difference) << size;
        EXPECT_EQ(difference->index, 0u);
        EXPECT_EQ(difference->expectedWords, 5000u);
        EXPECT_EQ(difference->gotWords, size);
        EXPECT_TRUE(difference->got.empty());
    }
}

} // namespace
} // namespace slant

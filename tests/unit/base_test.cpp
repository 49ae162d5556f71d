#include "base/error.h"
#include "base/parallel.h"

#include <atomic>
#include <gtest/gtest.h>
#include <vector>

namespace slant {
namespace {

TEST(Error, pointsAtTheFile) {
    const Error error = badInput({"a.pbrt", 3, 14}, "'{}' is not a number", "x");
    EXPECT_STREQ(error.what(), "a.pbrt:3:14: 'x' is not a number");
    EXPECT_EQ(error.code(), ErrorCode::badInput);
    EXPECT_EQ((FileLocation{"a", 2, 0}.text()), "a:2");
    EXPECT_EQ((FileLocation{"a", 0, 0}.text()), "a");
}

TEST(ParallelFor, visitsEveryIndexOnceAndPassesExceptionsOn) {
    const ThreadLimit limit(2);
    EXPECT_EQ(threadCount(), 2);
    std::vector<std::atomic<int>> visits(1013);
    parallelFor(0, visits.size(), 10, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) ++visits[i];
    });
    for (const auto& count : visits) EXPECT_EQ(count, 1);
    EXPECT_THROW(parallelFor(0, 100, 1,
                             [](std::size_t first, std::size_t) {
                                 if (first == 50) throw Error(ErrorCode::interrupted, "stop");
                             }),
                 Error);
}

} // namespace
} // namespace slant

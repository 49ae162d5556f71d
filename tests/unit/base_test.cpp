#include "base/error.h"
#include "base/parallel.h"

#include <atomic>
#include <chrono>
#include <gtest/gtest.h>
#include <mutex>
#include <set>
#include <thread>
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

TEST(ThreadLimit, holdsWhileItLives) {
    for (int time = 0; time < 2; ++time) {
        const ThreadLimit limit(1);
        EXPECT_EQ(threadCount(), 1);
        std::mutex mutex;
        std::set<std::thread::id> threads;
        parallelFor(0, 200, 1, [&](std::size_t, std::size_t) {
            std::this_thread::sleep_for(std::chrono::microseconds(100));
            const std::lock_guard lock(mutex);
            threads.insert(std::this_thread::get_id());
        });
        EXPECT_EQ(threads.size(), 1u);
    }
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

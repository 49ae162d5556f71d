// Parallel loops over oneTBB. Results must not depend on how the range is split: a body writes only to what
// belongs to its own indices.
#pragma once
#include <cstddef>
#include <functional>
#include <memory>

namespace slant {

/// Limits every parallel loop to `threads` threads (0 = all cores) while it lives.
class ThreadLimit {
public:
    explicit ThreadLimit(int threads);
    ~ThreadLimit();
    ThreadLimit(const ThreadLimit&) = delete;
    ThreadLimit& operator=(const ThreadLimit&) = delete;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Threads that a parallel loop uses now.
int threadCount();

/// Calls body(first, last) for pieces of [begin, end) of at least `grain` indices each, in any order. The
/// first exception that a body throws is thrown again here.
void parallelFor(std::size_t begin, std::size_t end, std::size_t grain,
                 const std::function<void(std::size_t first, std::size_t last)>& body);

} // namespace slant

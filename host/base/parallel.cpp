#include "base/parallel.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#ifdef SLANT_THREAD_SANITIZER
#include <sanitizer/tsan_interface.h>
#endif

namespace slant {
namespace {

// oneTBB orders the pieces of a loop after what was before it and before what comes after it. ThreadSanitizer
// cannot see into that library: this file is not instrumented (cmake/Compile.cmake), and says so instead.
#ifdef SLANT_THREAD_SANITIZER
void release(void* loop) {
    __tsan_release(loop);
}
void acquire(void* loop) {
    __tsan_acquire(loop);
}
#else
void release(void*) {}
void acquire(void*) {}
#endif

} // namespace

struct ThreadLimit::Impl {
    explicit Impl(int threads)
        : control(tbb::global_control::max_allowed_parallelism, std::size_t(threads)) {}
    tbb::global_control control; ///< known to oneTBB by its address: must not be copied
};

ThreadLimit::ThreadLimit(int threads) {
    if (threads > 0) impl_ = std::make_unique<Impl>(threads);
}

ThreadLimit::~ThreadLimit() = default;

int threadCount() {
    return int(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

void parallelFor(std::size_t begin, std::size_t end, std::size_t grain,
                 const std::function<void(std::size_t, std::size_t)>& body) {
    if (begin >= end) return;
    char begun = 0, ended = 0; // two, for the pieces are not ordered among themselves
    release(&begun);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(begin, end, grain),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                          acquire(&begun);
                          body(range.begin(), range.end());
                          release(&ended);
                      });
    acquire(&ended);
}

} // namespace slant

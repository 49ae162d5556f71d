#include "base/parallel.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#ifdef SLANT_THREAD_SANITIZER
#include <sanitizer/tsan_interface.h>
#endif

namespace slant {
namespace {

// oneTBB orders the pieces of a loop after what was before it and before what comes after it. ThreadSanitizer
// cannot see into that library, so this file is not instrumented (cmake/Compile.cmake) and tells it the order
// instead.
#ifdef SLANT_THREAD_SANITIZER
void release(void* address) {
    __tsan_release(address);
}
void acquire(void* address) {
    __tsan_acquire(address);
}
#else
void release(void*) {}
void acquire(void*) {}
#endif

/// Lives as long as a loop; a Piece as long as one of its pieces. Pieces are not ordered among themselves.
struct LoopOrder {
    LoopOrder() { release(&begun); }
    ~LoopOrder() { acquire(&ended); }

    struct Piece {
        explicit Piece(LoopOrder& order) : loop(order) { acquire(&order.begun); }
        ~Piece() { release(&loop.ended); }
        LoopOrder& loop;
    };

    char begun = 0, ended = 0;
};

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
    LoopOrder order;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(begin, end, grain),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                          const LoopOrder::Piece piece(order);
                          body(range.begin(), range.end());
                      });
}

} // namespace slant

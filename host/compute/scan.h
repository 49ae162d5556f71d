// Exclusive prefix sum on the device; exclusiveScan (base/sort.h) does the same on the CPU.
#pragma once
#include "compute/command_list.h"

namespace slant {

/// Records: each of the first `count` items of an r32ui buffer becomes the sum, modulo 2^32, of those before
/// it. Holds working memory of about maxCount / 255 words, so one scan at a time may be recorded or running.
class Scan {
public:
    Scan(Device& device, std::uint64_t maxCount);

    /// Makes room for scans of `maxCount` items; nothing recorded may be pending.
    void reserve(std::uint64_t maxCount);

    /// Throws Error(usage) if `count` is over `maxCount` or the buffer's size.
    void record(CommandList& commands, const Buffer& items, std::uint64_t count) const;

private:
    Device& device_;
    Pass reduce_;
    Pass apply_;
    std::uint64_t maxCount_ = 0;
    std::vector<Buffer> sums_; ///< of chunks; of chunks of those; ... down to one chunk
};

} // namespace slant

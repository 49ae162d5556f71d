#include "compute/scan.h"

#include "base/error.h"
#include "shared/scan.h"

namespace slant {
namespace {

std::uint64_t chunksOf(std::uint64_t count) {
    return (count + kScanChunk - 1) / kScanChunk;
}

} // namespace

Scan::Scan(Device& device, std::uint64_t maxCount)
    : device_(device), reduce_(device, "scan_reduce"), apply_(device, "scan_apply") {
    reserve(maxCount);
}

void Scan::reserve(std::uint64_t maxCount) {
    if (maxCount <= maxCount_) return;
    maxCount_ = maxCount;
    sums_.clear();
    for (std::uint64_t chunks = chunksOf(maxCount); chunks > 1; chunks = chunksOf(chunks))
        sums_.emplace_back(device_, TexelFormat::r32ui, chunks);
}

void Scan::record(CommandList& commands, const Buffer& items, std::uint64_t count) const {
    if (count > maxCount_ || count > items.texels())
        throw Error(ErrorCode::usage, fmt::format("scan of {} items: made for {}, the buffer holds {}", count,
                                                  maxCount_, items.texels()));
    struct Level {
        const Buffer* items;
        std::uint64_t count;
    };
    std::vector<Level> levels{{&items, count}};
    while (chunksOf(levels.back().count) > 1) {
        const Buffer& sums = sums_[levels.size() - 1];
        const Level level = levels.back();
        const std::uint64_t chunks = chunksOf(level.count);
        commands.dispatch(reduce_, {*level.items, sums}, ScanPush{uint(level.count), 0},
                          reduce_.gridFor(chunks));
        levels.push_back({&sums, chunks});
    }
    for (std::size_t i = levels.size(); i-- > 0;) {
        const auto [level, levelCount] = levels[i];
        const bool top = i + 1 == levels.size();
        commands.dispatch(apply_, {top ? *level : *levels[i + 1].items, *level, *level},
                          ScanPush{uint(levelCount), top ? 0u : 1u}, apply_.gridFor(chunksOf(levelCount)));
    }
}

} // namespace slant

#include "reconstruct/intermediates.h"

#include <algorithm>

namespace slant {
namespace {

/// FNV-1a over words (Fowler, Noll, Vo).
std::uint64_t hashOf(std::span<const uint> words) {
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (const uint word : words) hash = (hash ^ word) * 0x100000001b3u;
    return hash;
}

template <typename Visit>
void forEachBlock(std::span<const uint> words, Visit&& visit) {
    for (std::size_t first = 0; first < words.size(); first += IntermediateRecorder::kBlockWords)
        visit(first, words.subspan(first, std::min(IntermediateRecorder::kBlockWords, words.size() - first)));
}

} // namespace

void IntermediateRecorder::receive(const std::string& name, std::span<const uint> words) {
    Recorded& recorded = all_.emplace_back();
    recorded.name = name;
    recorded.words = words.size();
    forEachBlock(words,
                 [&](std::size_t, std::span<const uint> block) { recorded.blocks.push_back(hashOf(block)); });
}

void IntermediateComparer::receive(const std::string& name, std::span<const uint> words) {
    const std::size_t index = next_++;
    if (difference_) return;
    if (index >= expected_.all().size() || expected_.all()[index].name != name ||
        expected_.all()[index].words != words.size()) {
        const std::size_t expectedWords = index < expected_.all().size() ? expected_.all()[index].words : 0;
        difference_ = IntermediateDifference{index, name, expectedWords, words.size(), 0, {}};
        return;
    }
    const auto& blocks = expected_.all()[index].blocks;
    forEachBlock(words, [&](std::size_t first, std::span<const uint> block) {
        if (difference_ || hashOf(block) == blocks[first / IntermediateRecorder::kBlockWords]) return;
        difference_ = IntermediateDifference{
            index, name, words.size(), words.size(), first, std::vector<uint>(block.begin(), block.end())};
    });
}

std::optional<IntermediateDifference> IntermediateComparer::difference() const {
    if (difference_ || next_ == expected_.all().size()) return difference_;
    const auto& missing = expected_.all()[next_];
    return IntermediateDifference{next_, missing.name, missing.words, 0, 0, {}};
}

void IntermediateReader::receive(const std::string&, std::span<const uint> words) {
    if (next_++ != index_ || firstWord_ >= words.size()) return;
    const auto block = words.subspan(firstWord_, std::min(count_, words.size() - firstWord_));
    words_.assign(block.begin(), block.end());
}

} // namespace slant

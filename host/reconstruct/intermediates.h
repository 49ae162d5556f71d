// Two runs of the same reconstruction, compared stage by stage without keeping what the stages made: a hash
// of every block of words is enough to find the first difference, and a third run to read it.
#pragma once
#include "reconstruct/method.h"

#include <optional>

namespace slant {

/// Keeps hashes of what the first run makes.
class IntermediateRecorder final : public IntermediateObserver {
public:
    static constexpr std::size_t kBlockWords = 1024;

    struct Stage {
        std::string name;
        std::size_t words = 0;
        std::vector<std::uint64_t> blocks;
    };
    void stage(const std::string& name, std::span<const uint> words) override;
    const std::vector<Stage>& stages() const { return stages_; }

private:
    std::vector<Stage> stages_;
};

/// Where the second run first differed.
struct IntermediateDifference {
    std::size_t stage = 0; ///< in the order of the run
    std::string name;
    std::size_t expectedWords = 0, gotWords = 0;
    std::size_t firstWord = 0; ///< of `got`
    std::vector<uint> got;     ///< the block that differs; empty where only the size does
};

/// Holds the second run against the record of the first.
class IntermediateComparer final : public IntermediateObserver {
public:
    explicit IntermediateComparer(const IntermediateRecorder& expected) : expected_(expected) {}
    void stage(const std::string& name, std::span<const uint> words) override;

    /// The first difference, if any; call it when the run is over.
    std::optional<IntermediateDifference> difference() const;

private:
    const IntermediateRecorder& expected_;
    std::size_t next_ = 0;
    std::optional<IntermediateDifference> difference_;
};

/// Picks the words of one block out of a repetition of the first run.
class IntermediateReader final : public IntermediateObserver {
public:
    IntermediateReader(std::size_t stage, std::size_t firstWord, std::size_t count)
        : stage_(stage), firstWord_(firstWord), count_(count) {}
    void stage(const std::string& name, std::span<const uint> words) override;
    const std::vector<uint>& words() const { return words_; }

private:
    std::size_t stage_, firstWord_, count_, next_ = 0;
    std::vector<uint> words_;
};

} // namespace slant

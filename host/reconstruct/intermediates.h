// Intermediates: the results of the stages of a reconstruction, as words. Two runs are compared by them
// without storing them: a hash of every block of words finds the first difference, and a third run reads it.
#pragma once
#include "shared/types.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace slant {

/// Receives what the stages make, in the order in which they run, as 32-bit words. CPU and compute make the
/// same intermediates with the same words, so that the first difference points to the stage at fault.
class IntermediateObserver {
public:
    virtual ~IntermediateObserver() = default;
    virtual void receive(const std::string& name, std::span<const uint> words) = 0;
};

/// Keeps hashes of what the first run makes.
class IntermediateRecorder final : public IntermediateObserver {
public:
    static constexpr std::size_t kBlockWords = 1024;

    struct Recorded {
        std::string name;
        std::size_t words = 0;
        std::vector<std::uint64_t> blocks;
    };
    void receive(const std::string& name, std::span<const uint> words) override;
    const std::vector<Recorded>& all() const { return all_; }

private:
    std::vector<Recorded> all_;
};

/// Where the second run first differed.
struct IntermediateDifference {
    std::size_t index = 0; ///< in the order of the run
    std::string name;
    std::size_t expectedWords = 0, gotWords = 0;
    std::size_t firstWord = 0; ///< of `got`
    std::vector<uint> got;     ///< the block that differs; empty where only the size does
};

/// Compares the second run with the record of the first.
class IntermediateComparer final : public IntermediateObserver {
public:
    explicit IntermediateComparer(const IntermediateRecorder& expected) : expected_(expected) {}
    void receive(const std::string& name, std::span<const uint> words) override;

    /// The first difference, if any; call it when the run is over.
    std::optional<IntermediateDifference> difference() const;

private:
    const IntermediateRecorder& expected_;
    std::size_t next_ = 0;
    std::optional<IntermediateDifference> difference_;
};

/// Picks the words of one block from a repetition of the first run.
class IntermediateReader final : public IntermediateObserver {
public:
    IntermediateReader(std::size_t index, std::size_t firstWord, std::size_t count)
        : index_(index), firstWord_(firstWord), count_(count) {}
    void receive(const std::string& name, std::span<const uint> words) override;
    const std::vector<uint>& words() const { return words_; }

private:
    std::size_t index_, firstWord_, count_, next_ = 0;
    std::vector<uint> words_;
};

} // namespace slant

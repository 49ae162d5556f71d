// Progress and warnings for a person at a terminal or for a log file; never on stdout.
#pragma once
#include "base/monitor.h"

#include <atomic>
#include <cstdio>
#include <mutex>
#include <string>
#include <vector>

namespace slant::commands {

/// `text` with line breaks and other control characters replaced by spaces: the content of a file must
/// neither break the single line of a message nor control the terminal.
std::string oneLine(std::string_view text);

/// Writes to a stream that it does not own, and keeps what each finished stage cost.
class TerminalMonitor final : public Monitor {
public:
    enum class Style {
        quiet, ///< warnings only
        lines, ///< a line every few seconds and one at the end of a stage
        bar,   ///< a bar that is redrawn in place
    };
    explicit TerminalMonitor(Style style, std::FILE* stream = stderr) : style_(style), stream_(stream) {}
    /// Leaves the bar of an unfinished stage on a line of its own.
    ~TerminalMonitor() override;
    TerminalMonitor(const TerminalMonitor&) = delete;
    TerminalMonitor& operator=(const TerminalMonitor&) = delete;

    /// bar if stderr is a terminal, lines if not.
    static Style styleOfStderr(bool quiet);

    void beginStage(std::string_view name, std::uint64_t total, std::string_view unit) override;
    void advance(std::uint64_t items) override;
    void endStage() override;
    void warn(std::string_view message) override;

    /// Finished stages in the order in which they began; whoever ran one may add its device time and memory.
    std::vector<StageStats>& stages() { return stages_; }

private:
    void report(bool finished);

    const Style style_;
    std::FILE* const stream_;
    std::mutex mutex_; ///< guards the stream and what follows but done_
    bool running_ = false;
    bool barShown_ = false;
    std::string name_, unit_;
    std::uint64_t total_ = 0;
    std::atomic<std::uint64_t> done_ = 0;
    Stopwatch watch_;
    std::atomic<double> nextReport_ = 0; ///< seconds of watch_
    std::vector<StageStats> stages_;
};

} // namespace slant::commands

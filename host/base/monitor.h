// How long-running work talks to whoever started it: progress, warnings, cancellation and statistics of
// stages. The library only calls these; the commands decide what a person sees.
#pragma once
#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace slant {

/// What one stage of a run cost.
struct StageStats {
    std::string name;         ///< e.g. "trace", "reconstruct"
    double seconds = 0;       ///< wall-clock time on the host
    double deviceSeconds = 0; ///< timestamps of the compute device; 0 on the CPU path
    std::uint64_t items = 0;  ///< what `unit` counts
    std::string unit;         ///< e.g. "samples", "outputs", "pixels"
    std::uint64_t bytes = 0;  ///< peak memory of the stage's own buffers
};

/// Receives progress; throws Error(interrupted) from advance() when the run is to stop.
/// One thread at a time calls beginStage/endStage; any thread may call advance.
class Monitor {
public:
    virtual ~Monitor() = default;
    /// A stage of `total` items begins ("samples", "outputs", ...); ends the one before it.
    virtual void beginStage(std::string_view name, std::uint64_t total, std::string_view unit) = 0;
    /// `items` more are done. Throws Error(interrupted) when the user asked to stop.
    virtual void advance(std::uint64_t items) = 0;
    virtual void endStage() = 0;
    /// Something that the user should know but that does not stop the run; one line.
    virtual void warn(std::string_view message) = 0;
};

/// Does nothing; for tests and callers who do not care.
class SilentMonitor final : public Monitor {
public:
    void beginStage(std::string_view, std::uint64_t, std::string_view) override {}
    void advance(std::uint64_t) override {}
    void endStage() override {}
    void warn(std::string_view) override {}
};

/// Seconds since construction.
class Stopwatch {
public:
    double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

} // namespace slant

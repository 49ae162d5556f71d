// What a reconstruction encountered and cost.
#pragma once
#include "base/monitor.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace slant {

/// Counts of outputs that were made by searching, in bins or a window.
struct SearchCounts {
    std::uint64_t visibility = 0; ///< needed apparent surfaces to be separated
    std::uint64_t widened = 0;    ///< found nothing within 2 R (window: took the nearest sample)
    std::uint64_t holes = 0;      ///< found nothing at all and were left out (window: are black)
    std::uint64_t overflowed =
        0; ///< exceeded the candidate limit of the compute path and were done on the CPU

    void add(const SearchCounts& other) {
        visibility += other.visibility;
        widened += other.widened;
        holes += other.holes;
        overflowed += other.overflowed;
    }
};

struct ReconstructReport {
    std::uint64_t outputs = 0;     ///< reconstructed samples
    std::uint64_t fromMap = 0;     ///< of them, those that were taken from the layer map
    SearchCounts search;           ///< of the others
    std::uint64_t emptyPixels = 0; ///< pixels that no sample reached
    std::vector<float> mapShare;   ///< of each pixel of the frame, see addMapShare
    std::vector<StageStats> stages;

    /// The stage of that name, made at the end of the list if there is none.
    StageStats& stage(const std::string& name, const char* unit);
};

/// Adds the time from construction to destruction to a stage of a report.
class StageTimer {
public:
    /// `name` and `unit` must outlive the timer.
    StageTimer(ReconstructReport& report, const char* name, const char* unit)
        : report_(report), name_(name), unit_(unit) {}
    ~StageTimer() {
        StageStats& stage = report_.stage(name_, unit_);
        stage.seconds += watch_.seconds();
        stage.items += items;
        stage.bytes = std::max(stage.bytes, bytes);
    }
    StageTimer(const StageTimer&) = delete;
    StageTimer& operator=(const StageTimer&) = delete;

    std::uint64_t items = 0, bytes = 0;

private:
    ReconstructReport& report_;
    const char* name_;
    const char* unit_;
    Stopwatch watch_;
};

} // namespace slant

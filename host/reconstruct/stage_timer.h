// Adds the time from construction to destruction to a stage of a report.
#pragma once
#include "reconstruct/method.h"

#include <algorithm>

namespace slant {

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

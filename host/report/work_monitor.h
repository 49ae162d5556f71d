// Progress of nested work.
#pragma once
#include "base/monitor.h"

#include <cstdint>
#include <mutex>
#include <set>
#include <string>
#include <utility>

namespace slant {

/// Stands between nested work and the monitor of the whole: it hides the stages of the nested work, and
/// counts their progress towards a share of the whole that was announced before: never more, and in the end
/// never less. Each warning is passed on once.
class WorkMonitor final : public Monitor {
public:
    /// `whole` must outlive it and have a stage running while work is done.
    explicit WorkMonitor(Monitor& whole) : whole_(whole) {}

    /// Work of `items` of the whole begins; ends the one before.
    void beginShare(std::uint64_t items, std::string prefix) {
        endShare();
        const std::scoped_lock lock(mutex_);
        left_ = items;
        prefix_ = std::move(prefix);
    }
    void endShare() { advance(left()); }

    void beginStage(std::string_view, std::uint64_t, std::string_view) override {}
    void advance(std::uint64_t items) override {
        std::uint64_t counted = 0;
        {
            const std::scoped_lock lock(mutex_);
            counted = std::min(items, left_);
            left_ -= counted;
        }
        whole_.advance(counted); // also when nothing counts: it may want to stop
    }
    void endStage() override {}
    void warn(std::string_view message) override {
        const std::scoped_lock lock(mutex_);
        const std::string text = prefix_ + std::string(message);
        if (warned_.insert(text).second) whole_.warn(text);
    }

private:
    std::uint64_t left() {
        const std::scoped_lock lock(mutex_);
        return left_;
    }

    Monitor& whole_;
    std::mutex mutex_; ///< guards what follows
    std::uint64_t left_ = 0;
    std::string prefix_;
    std::set<std::string> warned_;
};

} // namespace slant

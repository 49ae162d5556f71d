// Wall-clock medians.
#pragma once
#include "base/monitor.h"

#include <algorithm>
#include <vector>

namespace slant {

struct Timing {
    double seconds = 0; ///< median
    int runs = 0;       ///< that it is of
};

/// Median of a list that is not empty; of an even number, the mean of the middle two.
inline double medianOf(std::vector<double> values) {
    std::ranges::sort(values);
    const std::size_t half = values.size() / 2;
    return values.size() % 2 ? values[half] : (values[half - 1] + values[half]) / 2;
}

/// A run that takes this long needs neither a warm-up nor repetitions.
inline constexpr double kLongRunSeconds = 10;

/// Runs `work` once to warm up and then `repeat` times with the clock; if the first run is long, it counts.
template <typename Work>
Timing timeRuns(int repeat, const Work& work) {
    const Stopwatch first;
    work();
    if (const double seconds = first.seconds(); seconds >= kLongRunSeconds) return {seconds, 1};
    std::vector<double> seconds;
    for (int i = 0; i < repeat; ++i) {
        const Stopwatch watch;
        work();
        seconds.push_back(watch.seconds());
    }
    return {medianOf(seconds), repeat};
}

} // namespace slant

// Speed against error: Pareto fronts, and how much faster one is than another.
#pragma once
#include <optional>
#include <span>
#include <vector>

namespace slant {

/// One setting's price and result; both > 0.
struct Cost {
    double seconds = 0;
    double error = 0;
};

/// The costs that no other one beats or equals in both, by rising seconds and so by falling error; without
/// those that are not finite and positive.
std::vector<Cost> paretoFront(std::span<const Cost> costs);

/// Seconds at which a front reaches an error, along straight lines of log error over log seconds; nothing
/// outside its range.
std::optional<double> secondsAt(std::span<const Cost> front, double error);
/// The reverse.
std::optional<double> errorAt(std::span<const Cost> front, double seconds);

/// A quotient, or a lower bound of it if one of the fronts ends before.
struct Factor {
    double value = 0;
    bool atLeast = false;
};

/// What a front gains over the reference's at an error; nothing if neither a value nor a bound is known.
struct Gain {
    std::optional<Factor>
        equalError; ///< seconds of the reference over seconds of the front, to reach the error
    std::optional<Factor> equalTime; ///< error of the reference over that of the front, in the front's time
};

/// A front that starts below `error` is taken at its first, cheapest point.
Gain gainAt(std::span<const Cost> front, std::span<const Cost> reference, double error);

} // namespace slant

#include "report/curves.h"

#include <algorithm>
#include <cmath>

namespace slant {
namespace {

/// y at x between (x0, y0) and (x1, y1), a power law.
double powerLaw(double x, double x0, double y0, double x1, double y1) {
    const double t = std::log(x / x0) / std::log(x1 / x0);
    return y0 * std::pow(y1 / y0, t);
}

/// The value of `from` where `to` has the given value; the front's order makes both monotone.
template <double Cost::*from, double Cost::*to>
std::optional<double> along(std::span<const Cost> front, double target) {
    for (std::size_t i = 0; i < front.size(); ++i) {
        if (front[i].*to == target) return front[i].*from;
        if (i == 0) continue;
        const Cost &a = front[i - 1], &b = front[i];
        if ((a.*to < target) != (b.*to < target)) return powerLaw(target, a.*to, a.*from, b.*to, b.*from);
    }
    return {};
}

bool isUsable(const Cost& cost) {
    return std::isfinite(cost.seconds) && std::isfinite(cost.error) && cost.seconds > 0 && cost.error > 0;
}

} // namespace

std::vector<Cost> paretoFront(std::span<const Cost> costs) {
    std::vector<Cost> sorted;
    std::ranges::copy_if(costs, std::back_inserter(sorted), isUsable);
    std::ranges::sort(sorted, [](const Cost& a, const Cost& b) {
        return a.seconds != b.seconds ? a.seconds < b.seconds : a.error < b.error;
    });
    std::vector<Cost> front;
    for (const Cost& cost : sorted)
        if (front.empty() || cost.error < front.back().error) front.push_back(cost);
    return front;
}

std::optional<double> secondsAt(std::span<const Cost> front, double error) {
    return along<&Cost::seconds, &Cost::error>(front, error);
}

std::optional<double> errorAt(std::span<const Cost> front, double seconds) {
    return along<&Cost::error, &Cost::seconds>(front, seconds);
}

Gain gainAt(std::span<const Cost> front, std::span<const Cost> reference, double error) {
    if (front.empty() || reference.empty()) return {};
    Cost own{0, error};
    const bool startsBelow = front.front().error < error;
    if (startsBelow)
        own = front.front();
    else if (const auto seconds = secondsAt(front, error))
        own.seconds = *seconds;
    else
        return {};

    Gain gain;
    if (const auto seconds = secondsAt(reference, error))
        gain.equalError = {*seconds / own.seconds, startsBelow};
    else if (reference.back().error > error)
        gain.equalError = {reference.back().seconds / own.seconds, true};
    if (const auto atSameTime = errorAt(reference, own.seconds))
        gain.equalTime = {*atSameTime / own.error, false};
    else if (own.seconds < reference.front().seconds)
        gain.equalTime = {reference.front().error / own.error, true};
    return gain;
}

} // namespace slant

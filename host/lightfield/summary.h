// Statistics of a light field.
#pragma once
#include "lightfield/lightfield.h"

#include <array>
#include <limits>

namespace slant {

/// Of finite values; low > high where there is none.
struct ValueRange {
    float low = std::numeric_limits<float>::infinity(), high = -std::numeric_limits<float>::infinity();
    bool empty() const { return low > high; }
};

struct FieldSummary {
    static constexpr std::array kNames = {"x", "y", "u", "v", "t", "w", "slope", "r", "g", "b"};
    std::array<ValueRange, kNames.size()> ranges;   ///< in that order, of the samples as they are
    FieldDefects defects;                           ///< what `sanitize` would meet
    std::uint64_t background = 0;                   ///< samples at infinite depth
    std::uint64_t moving = 0;                       ///< samples that `sanitize` would leave moving
    double largestMotionPx = 0, medianMotionPx = 0; ///< of these, from shutter open to close (motion.h)
    std::uint64_t outsidePixel = 0; ///< samples whose (x, y) lies outside the pixel that has them
};

FieldSummary summarize(const LightField& field);

} // namespace slant

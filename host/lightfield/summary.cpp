#include "lightfield/summary.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>
#include <mutex>

namespace slant {
namespace {

void addValue(ValueRange& range, float value) {
    if (!std::isfinite(value)) return;
    range.low = std::min(range.low, value);
    range.high = std::max(range.high, value);
}

void addSample(FieldSummary& summary, const LightFieldSample& s, glm::vec3 radiance, int column, int row) {
    const std::array values = {s.x, s.y, s.u, s.v, s.t, s.w, s.slope, radiance.r, radiance.g, radiance.b};
    for (std::size_t i = 0; i < values.size(); ++i) addValue(summary.ranges[i], values[i]);
    summary.background += std::isinf(s.w) && s.w > 0;
    summary.outsidePixel += std::floor(s.x) != float(column) || std::floor(s.y) != float(row);
    LightFieldSample copy = s;
    repair(copy, radiance, summary.defects);
}

void addSummary(FieldSummary& sum, const FieldSummary& part) {
    for (std::size_t i = 0; i < sum.ranges.size(); ++i)
        for (const float value : {part.ranges[i].low, part.ranges[i].high}) addValue(sum.ranges[i], value);
    sum.defects.add(part.defects);
    sum.background += part.background;
    sum.outsidePixel += part.outsidePixel;
}

} // namespace

FieldSummary summarize(const LightField& field) {
    FieldSummary sum;
    std::mutex mutex;
    const auto width = std::size_t(field.bounds.width());
    parallelFor(0, std::size_t(field.bounds.height()), 1, [&](std::size_t first, std::size_t last) {
        FieldSummary local;
        for (std::size_t j = first; j < last; ++j)
            for (std::size_t i = 0; i < width; ++i)
                for (std::size_t k = field.firstSample(j * width + i);
                     k < field.firstSample(j * width + i + 1); ++k)
                    addSample(local, field.samples[k], field.radiance[k], field.bounds.x0 + int(i),
                              field.bounds.y0 + int(j));
        const std::lock_guard lock(mutex);
        addSummary(sum, local);
    });
    return sum;
}

} // namespace slant

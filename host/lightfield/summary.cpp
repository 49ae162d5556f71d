#include "lightfield/summary.h"

#include "base/parallel.h"
#include "lightfield/motion.h"

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

/// Of some rows.
struct Part {
    FieldSummary summary;
    std::vector<float> motionsPx; ///< of samples that move

    void add(const LightField& field, std::size_t sample, int column, int row);
};

void Part::add(const LightField& field, std::size_t sample, int column, int row) {
    LightFieldSample s = field.samples[sample];
    glm::vec3 radiance = field.radiance[sample];
    const std::array values = {s.x, s.y, s.u, s.v, s.t, s.w, s.slope, radiance.r, radiance.g, radiance.b};
    for (std::size_t i = 0; i < values.size(); ++i) addValue(summary.ranges[i], values[i]);
    summary.background += std::isinf(s.w) && s.w > 0;
    summary.outsidePixel += std::floor(s.x) != float(column) || std::floor(s.y) != float(row);
    glm::vec3 motion = field.moves() ? field.motion[sample] : glm::vec3(0);
    repair(field, s, radiance, motion, summary.defects);
    if (motion == glm::vec3(0)) return;
    const float motionPx = glm::length(displacementPx(field, s, motion));
    motionsPx.push_back(std::isfinite(motionPx) ? motionPx : std::numeric_limits<float>::infinity());
}

void addPart(Part& sum, const Part& part) {
    for (std::size_t i = 0; i < sum.summary.ranges.size(); ++i)
        for (const float value : {part.summary.ranges[i].low, part.summary.ranges[i].high})
            addValue(sum.summary.ranges[i], value);
    sum.summary.defects.add(part.summary.defects);
    sum.summary.background += part.summary.background;
    sum.summary.outsidePixel += part.summary.outsidePixel;
    sum.motionsPx.insert(sum.motionsPx.end(), part.motionsPx.begin(), part.motionsPx.end());
}

FieldSummary finished(Part& part) {
    FieldSummary& summary = part.summary;
    std::vector<float>& motions = part.motionsPx;
    summary.moving = motions.size();
    if (motions.empty()) return summary;
    const auto middle = motions.begin() + long(motions.size() / 2);
    std::nth_element(motions.begin(), middle, motions.end());
    summary.medianMotionPx = double(*middle);
    summary.largestMotionPx = double(*std::max_element(middle, motions.end()));
    return summary;
}

} // namespace

FieldSummary summarize(const LightField& field) {
    Part sum;
    std::mutex mutex;
    const auto width = std::size_t(field.bounds.width());
    parallelFor(0, std::size_t(field.bounds.height()), 1, [&](std::size_t first, std::size_t last) {
        Part local;
        for (std::size_t j = first; j < last; ++j)
            for (std::size_t i = 0; i < width; ++i)
                for (std::size_t k = field.firstSample(j * width + i);
                     k < field.firstSample(j * width + i + 1); ++k)
                    local.add(field, k, field.bounds.x0 + int(i), field.bounds.y0 + int(j));
        const std::lock_guard lock(mutex);
        addPart(sum, local);
    });
    return finished(sum);
}

} // namespace slant

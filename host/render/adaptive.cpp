#include "render/adaptive.h"

#include "base/error.h"
#include "trace/sample_pass.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace slant {

int firstPassSamples(int samplesPerPixel, double placedShare) {
    return std::max(1, int(std::lround(samplesPerPixel * (1 - placedShare))));
}

SamplePlacement::SamplePlacement(const Tracer& tracer, const SampleOptions& options, TracedField& traced,
                                 Monitor& monitor)
    : tracer_(tracer), options_(options), traced_(traced), monitor_(monitor) {
    if (tracer.camera().compoundLens())
        throw Error(ErrorCode::usage,
                    "samples cannot be placed where they are needed through a compound lens: "
                    "all pixels of its fields have equally many");
}

std::uint64_t SamplePlacement::add(const ErrorEstimate& estimate, std::uint64_t samples) {
    const std::uint64_t extra = std::min(samples, roomForMore(traced_.field, options_));
    const std::vector<std::uint32_t> more = estimate.place(counts(), extra);
    const std::uint64_t placed = std::accumulate(more.begin(), more.end(), std::uint64_t(0));
    if (placed > 0) traced_.defects.add(traceMore(tracer_, options_, more, ++pass_, traced_.field, monitor_));
    return placed;
}

std::uint64_t SamplePlacement::samples() const {
    const std::vector<std::uint32_t> all = counts();
    return std::accumulate(all.begin(), all.end(), std::uint64_t(0));
}

std::vector<std::uint32_t> SamplePlacement::counts() const {
    const LightField& field = traced_.field;
    std::vector<std::uint32_t> counts;
    for (int y = field.frame.y0; y < field.frame.y1; ++y)
        for (int x = field.frame.x0; x < field.frame.x1; ++x)
            counts.push_back(std::uint32_t(
                field.samplesOf(std::size_t(y - field.bounds.y0) * std::size_t(field.bounds.width()) +
                                std::size_t(x - field.bounds.x0))));
    return counts;
}

} // namespace slant

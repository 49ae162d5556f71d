#include "lightfield/refocus.h"

#include "base/error.h"
#include "base/parallel.h"
#include "lib/trajectory.glsl"

#include <algorithm>
#include <cmath>
#include <mutex>

namespace slant {

std::optional<double> focusDistance(const SlopeModel& model) {
    if (!(model.c1 < 0) || !(model.c2 > 0)) return {};
    return -double(model.c1) / double(model.c2);
}

SlopeModel focusedAt(const LightField& field, double distance) {
    if (!(distance > 0))
        throw Error(ErrorCode::usage, fmt::format("a focus distance of {} is not positive", distance));
    if (field.slopeModel.c1 == 0)
        throw Error(ErrorCode::usage, "the field was traced through a pinhole: everything is in focus");
    if (!isThinLens(field))
        throw Error(ErrorCode::usage,
                    "the field is not that of a thin lens: its slopes are not C1/w + C2, and "
                    "what another focus would make of them is not known");
    SlopeModel model = field.slopeModel;
    model.c2 = float(-double(model.c1) / distance);
    if (!std::isfinite(model.c2))
        throw Error(ErrorCode::usage, fmt::format("with the focus at {} blur is infinite", distance));
    return model;
}

int missingOverscanPx(const LightField& field, const LensView& view) {
    const Rect &frame = field.frame, &bounds = field.bounds;
    const auto width = std::size_t(bounds.width());
    float missing = 0;
    std::mutex mutex;
    parallelFor(
        std::size_t(frame.y0 - bounds.y0), std::size_t(frame.y1 - bounds.y0), 1,
        [&](std::size_t first, std::size_t last) {
            float here = 0;
            for (std::size_t i = field.firstSample(first * width); i < field.firstSample(last * width); ++i) {
                const LightFieldSample& s = field.samples[i];
                const float radius = std::abs(s.slope + view.slopeShift) * view.apertureScale;
                const vec2 p = pinholeOf(vec2(s.x, s.y), vec2(s.u, s.v), s.slope);
                if (!std::isfinite(radius) || !std::isfinite(p.x + p.y)) continue;
                // The neighbours of a point in the frame that is spread this far are spread as far.
                if (p.x < float(frame.x0) || p.x > float(frame.x1)) continue;
                if (p.y < float(frame.y0) || p.y > float(frame.y1)) continue;
                here = std::max({here, float(bounds.x0) - (p.x - radius), float(bounds.y0) - (p.y - radius),
                                 p.x + radius - float(bounds.x1), p.y + radius - float(bounds.y1)});
            }
            const std::lock_guard lock(mutex);
            missing = std::max(missing, here);
        });
    return int(std::ceil(std::min(missing, 1e6f)));
}

} // namespace slant

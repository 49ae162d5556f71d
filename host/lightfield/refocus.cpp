#include "lightfield/refocus.h"

#include "base/error.h"
#include "base/parallel.h"
#include "lib/trajectory.glsl"
#include "lightfield/motion.h"

#include <algorithm>
#include <cmath>
#include <mutex>

namespace slant {
namespace {

/// How far beyond the bounds a sample's point is seen, if it is in the frame at the sample's own time.
float reachBeyond(const LightField& field, const LensView& view, std::size_t sample) {
    const LightFieldSample& s = field.samples[sample];
    const Rect &frame = field.frame, &bounds = field.bounds;
    const vec2 p = pinholeOf(vec2(s.x, s.y), vec2(s.u, s.v), s.slope);
    // The neighbours of a point in the frame that is spread this far are spread as far.
    if (!(p.x >= float(frame.x0) && p.x <= float(frame.x1))) return 0;
    if (!(p.y >= float(frame.y0) && p.y <= float(frame.y1))) return 0;
    const vec3 q = field.moves() ? relativeMotion(s, field.motion[sample]) : vec3(0);
    float reach = 0;
    // Between these times position and slope are monotone.
    for (const float time : {-s.t, 0.f, 1 - s.t}) {
        const MovedPoint point = moved(p, q, time);
        const float slope = s.slope + field.slopeModel.c1 / s.w * (1 / point.depthRatio - 1);
        const float radius = std::abs(slope + view.slopeShift) * view.apertureScale;
        const vec2 low = point.position - radius, high = point.position + radius;
        if (std::isfinite(low.x + low.y + high.x + high.y))
            reach = std::max({reach, float(bounds.x0) - low.x, float(bounds.y0) - low.y,
                              high.x - float(bounds.x1), high.y - float(bounds.y1)});
        if (q == vec3(0)) break;
    }
    return reach;
}

} // namespace

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
    const auto width = std::size_t(field.bounds.width());
    const Rect &frame = field.frame, &bounds = field.bounds;
    float missing = 0;
    std::mutex mutex;
    parallelFor(std::size_t(frame.y0 - bounds.y0), std::size_t(frame.y1 - bounds.y0), 1,
                [&](std::size_t first, std::size_t last) {
                    float here = 0;
                    for (std::size_t i = field.firstSample(first * width);
                         i < field.firstSample(last * width); ++i)
                        here = std::max(here, reachBeyond(field, view, i));
                    const std::lock_guard lock(mutex);
                    missing = std::max(missing, here);
                });
    return int(std::ceil(std::min(missing, 1e6f)));
}

} // namespace slant

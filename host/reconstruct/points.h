// The samples of a field as points in the middle of the shutter, seen from the middle of the lens
// (shaders/lib/motion.glsl). For source files only, as reconstruct/kernels.h is.
#pragma once
#include "lightfield/scene_side.h"
#include "reconstruct/kernels.h"

#include <algorithm>

namespace slant {

/// Where nothing moves they are as their samples have them, and their motions are 0.
class Points {
public:
    /// What is given must outlive it.
    explicit Points(const SceneSideSamples& source)
        : samples_(source.samples()), motion_(source.field().motion), c2_(source.field().slopeModel.c2) {}

    std::size_t size() const { return samples_.size(); }
    bool move() const { return !motion_.empty(); }
    const LightFieldSample& sample(std::size_t i) const { return samples_[i]; }
    /// 1 / w, bounded so that it stays finite for depths of any size.
    float nearness(std::size_t i) const { return std::min(1 / samples_[i].w, 1e30f); }
    /// Homogeneous motion over depth, and nearness: what atMiddle takes.
    vec4 relativeMotion(std::size_t i) const {
        return {slant::relativeMotion(samples_[i], motion_[i]), nearness(i)};
    }
    MovingPoint operator[](std::size_t i) const {
        const Trajectory seen = trajectoryOf(samples_[i]);
        if (!move()) return {seen, {}, 0};
        return atMiddle(seen, samples_[i].t, relativeMotion(i), c2_);
    }
    bool reaches(const MovingPoint& point, const Rect& region, float marginPx) const {
        const vec2 low(float(region.x0), float(region.y0)), high(float(region.x1), float(region.y1));
        return move() ? reachesMoving(point, low, high, marginPx)
                      : slant::reaches(point.trajectory, low, high, marginPx);
    }

private:
    std::span<const LightFieldSample> samples_;
    std::span<const vec3> motion_;
    float c2_;
};

} // namespace slant

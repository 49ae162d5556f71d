#include "lightfield/motion.h"

#include "lib/trajectory.glsl"

#include <algorithm>

namespace slant {
namespace {

/// The nearer of both ends of the shutter, over the sample's own depth.
float nearestApproach(const LightFieldSample& s, const glm::vec3& motion) {
    const float speed = relativeMotion(s, motion).z;
    return std::min(1 - s.t * speed, 1 + (1 - s.t) * speed);
}

/// The motion's w over the depth, limited so that 1 - t r >= kNearestApproach and 1 + (1 - t) r likewise; by
/// a little more than rounding may undo, so that it is not limited a second time.
double limitedSpeed(double time, double speed) {
    constexpr double kMost = 1 - 1.0001 * double(kNearestApproach);
    if (time > 0) speed = std::min(speed, kMost / time);
    if (time < 1) speed = std::max(speed, -kMost / (1 - time));
    return speed;
}

} // namespace

glm::vec2 pinholePosition(const LightField& field, const LightFieldSample& s) {
    if (field.lensMap.empty()) return pinholeOf({s.x, s.y}, {s.u, s.v}, s.slope);
    const SceneRay ray = field.lensMap.at({s.x, s.y}, {s.u, s.v});
    return pinholeOf(ray.xy, ray.uv, s.slope);
}

glm::vec2 displacementPx(const LightField& field, const LightFieldSample& s, const glm::vec3& motion) {
    if (motion == glm::vec3(0)) return glm::vec2(0);
    const glm::vec3 q = relativeMotion(s, motion);
    // The difference of both ends, p' = (p - t q.xy) / (1 - t q.z) and so on, without cancellation.
    const glm::vec2 velocity = glm::vec2(q) - q.z * pinholePosition(field, s);
    return velocity / ((1 - s.t * q.z) * (1 + (1 - s.t) * q.z));
}

bool limitMotion(const LightField& field, const LightFieldSample& s, glm::vec3& motion) {
    if (!(nearestApproach(s, motion) < kNearestApproach)) return false;
    const glm::dvec2 p = pinholePosition(field, s);
    const double depth = std::isinf(s.w) ? 1 : double(s.w);
    float w = float(limitedSpeed(double(s.t), double(motion.z) / depth) * depth);
    // Where depths are so small that floats are coarse, rounding may undo it.
    if (!(nearestApproach(s, {0, 0, w}) >= kNearestApproach / 2)) w = 0;
    const double change = double(w) - double(motion.z);
    motion = {float(double(motion.x) + change * p.x), float(double(motion.y) + change * p.y), w};
    return true;
}

} // namespace slant

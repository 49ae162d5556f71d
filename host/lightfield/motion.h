// Where the points of a field go while the shutter is open (lightfield.h has the formulas). Positions are in
// pixels as seen from the lens's centre; through a compound lens those of the scene's side, without its
// distortion.
#pragma once
#include "lightfield/lightfield.h"

namespace slant {

/// The nearest that a point may come within the shutter, over its depth at the sample's own time.
inline constexpr float kNearestApproach = 1.f / 16;

inline bool isFinite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Where a sample's point is at the sample's own time.
glm::vec2 pinholePosition(const LightField& field, const LightFieldSample& sample);

/// A point at another time: its position, and its depth over that at the sample's own time.
struct MovedPoint {
    glm::vec2 position;
    float depthRatio;
};
/// Of a point at `position`, with the motion over its depth, after `time`.
inline MovedPoint moved(glm::vec2 position, const glm::vec3& relativeMotion, float time) {
    const float ratio = 1 + time * relativeMotion.z;
    return {(position + time * glm::vec2(relativeMotion)) / ratio, ratio};
}

/// How far a sample's point moves from shutter open to close. The motion must be within kNearestApproach.
glm::vec2 displacementPx(const LightField& field, const LightFieldSample& sample, const glm::vec3& motion);

/// Limits the finite motion of a sample that is valid otherwise by kNearestApproach, as FieldDefects says;
/// whether that was necessary.
bool limitMotion(const LightField& field, const LightFieldSample& sample, glm::vec3& motion);

} // namespace slant

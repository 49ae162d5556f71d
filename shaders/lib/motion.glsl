// Trajectories of points that move in time (host/lightfield/lightfield.h has the formula that they follow).
//
// A straight line in homogeneous coordinates stays a straight line in pinhole position and slope; only how
// far along it a point is does not go evenly with time where its depth changes.
#ifndef SLANT_LIB_MOTION_GLSL
#define SLANT_LIB_MOTION_GLSL
#include "shared/motion.h"
#include "lib/trajectory.glsl"

SLANT_SHARED_BEGIN

/// In the middle of the shutter, per shutter. As one texel: in this order.
struct Motion {
    vec2 velocity;   // of the pinhole position
    float depthRate; // of depth, relative to it
    float slopeRate;
};

KERNEL Motion motionOf(vec4 texel) {
    const Motion motion = {vec2(texel), texel.z, texel.w};
    return motion;
}
KERNEL vec4 texelOf(IN(Motion) motion) {
    return vec4(motion.velocity, motion.depthRate, motion.slopeRate);
}

/// A point in the middle of the shutter.
struct MovingPoint {
    Trajectory trajectory;
    Motion motion;
    float nearness; // 1 / w
};

/// The point of a sample at `t` of the shutter; `relative` is its homogeneous motion over its depth, and 1 /
/// w.
KERNEL MovingPoint atMiddle(IN(Trajectory) seen, float t, vec4 relative, float c2) {
    const float back = 0.5f - t, depth = 1.0f + back * relative.z; // relative to the sample's
    const vec2 p = (seen.pinhole + back * vec2(relative)) / depth;
    const float slope = relative.z == 0.0f ? seen.slope : c2 + (seen.slope - c2) / depth;
    const float depthRate = relative.z / depth;
    const MovingPoint point = {{p, slope},
                               {vec2(relative) / depth - depthRate * p, depthRate, -depthRate * (slope - c2)},
                               relative.w / depth};
    return point;
}

KERNEL Trajectory atTime(IN(Trajectory) trajectory, IN(Motion) motion, float time) {
    const float progress = time / (1.0f + time * motion.depthRate);
    const Trajectory moved = {trajectory.pinhole + progress * motion.velocity,
                              trajectory.slope + progress * motion.slopeRate};
    return moved;
}

/// Bounded, so that differences of ranks stay finite.
KERNEL float rankOf(IN(MotionLayout) layout_, float slope, float nearness) {
    const float rank = layout_.rankPerSlope * (slope - layout_.c2) - layout_.rankPerNearness * nearness;
    return clamp(rank, -kFarRank, kFarRank);
}
/// Ranks go with 1 / w.
KERNEL float rankAt(float rank, float depthRate, float time) {
    return rank / (1.0f + time * depthRate);
}

/// How far a point is spread to each side over lens and shutter, pixels: as far as a still one of that slope.
KERNEL float blurOf(IN(MovingPoint) point) {
    const vec2 half_ = 0.5f * abs(point.motion.velocity);
    return max(abs(point.trajectory.slope), max(half_.x, half_.y));
}

/// The slope of what keeps still and is blurred over as large an area as something of slope `slope` that
/// moves at `speed`, pixels per shutter: pi slope^2 + 2 slope speed.
KERNEL float blurSpread(float slope, float speed) {
    const float s = max(slope, 0.0f);
    return sqrt(s * (s + 0.636619772f * speed));
}

/// Class of a point among those that the table of layers has (host/reconstruct/motion_grid.h).
KERNEL int layerClass(IN(MotionLayout) layout_, float rank, vec2 velocity) {
    const float bucket =
        clamp(floor((rank - layout_.rankMin) * layout_.invRank), 0.0f, layout_.rankCount - 1.0f);
    const vec2 step_ = clamp(floor((velocity - layout_.velocityMin) * layout_.invVelocity), vec2(0.0f),
                             layout_.velocityCount - 1.0f);
    return (int(bucket) * int(layout_.velocityCount.y) + int(step_.y)) * int(layout_.velocityCount.x) +
           int(step_.x);
}

/// Drift of BrickMotion.
KERNEL vec2 driftOf(IN(MovingPoint) point, vec2 center) {
    return point.motion.velocity + point.motion.depthRate * (point.trajectory.pinhole - center);
}

KERNEL bool keepsStill(IN(BrickMotion) motion) {
    return motion.low == vec2(0.0f) && motion.high == vec2(0.0f) && motion.depthRate == vec2(0.0f);
}

/// How far from x - slope uv the points of a brick lie in the middle of the shutter that an output at x
/// through uv sees at `time`.
KERNEL Shift shiftBack(IN(BrickMotion) motion, vec2 x, vec2 uv, float time, float c2) {
    const vec2 far = x - c2 * uv - motion.center; // where it looks at infinity
    const vec2 a = motion.depthRate.x * far, b = motion.depthRate.y * far;
    const vec2 low = min(a, b) - motion.high, high = max(a, b) - motion.low;
    const vec2 c = time * low, d = time * high;
    const Shift shift = {min(c, d), max(c, d)};
    return shift;
}

/// The greatest depth of a brick's points at `time`, over that in the middle of the shutter.
KERNEL float widestDepthAt(IN(BrickMotion) motion, float time) {
    return 1.0f + max(time * motion.depthRate.x, time * motion.depthRate.y);
}

/// The least slope of a brick at `time`.
KERNEL float leastSlopeAt(IN(BrickMotion) motion, float slopeMin, float time, float c2) {
    const float a = 1.0f + time * motion.depthRate.x, b = 1.0f + time * motion.depthRate.y;
    return c2 + min((slopeMin - c2) / a, (slopeMin - c2) / b);
}

SLANT_SHARED_END
#endif

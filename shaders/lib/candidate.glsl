// A sample seen from an output's lens position, and whether samples surround an output.
#ifndef SLANT_LIB_CANDIDATE_GLSL
#define SLANT_LIB_CANDIDATE_GLSL
#include "shared/kernel.h"

SLANT_SHARED_BEGIN

struct Candidate {
    vec2 offset;     // from the output, pixels of the film
    float distance2; // scaled as if its own radius were that of the search
    float slope;
    float weight; // see lib/occlusion.glsl
    vec4 value;   // rgb; R over its own radius
    vec3 motion;  // velocity, pixels per shutter; depth rate
};

KERNEL vec2 velocityOf(IN(Candidate) candidate) {
    return vec2(candidate.motion);
}

/// Bounds of velocities.
struct VelocityBox {
    vec2 low, high;
};

KERNEL VelocityBox noVelocities() {
    const VelocityBox box = {vec2(kInfinity), vec2(-kInfinity)};
    return box;
}
KERNEL void addVelocity(INOUT(VelocityBox) box, vec2 velocity) {
    box.low = min(box.low, velocity);
    box.high = max(box.high, velocity);
}
/// Whether a velocity differs by more than `gap` from all.
KERNEL bool isApart(IN(VelocityBox) box, vec2 velocity, float gap) {
    return velocity.x < box.low.x - gap || velocity.y < box.low.y - gap || velocity.x > box.high.x + gap ||
           velocity.y > box.high.y + gap;
}

/// Whether a place lies inside the convex hull of points that come one at a time: it does if, seen from it,
/// the points above span directions beyond those below on both sides.
struct Hull {
    vec2 upper; // least and greatest x/y of points with y >= 0
    vec2 lower; // ... with y < 0
};

KERNEL Hull noHull() {
    const Hull hull = {vec2(kInfinity, -kInfinity), vec2(kInfinity, -kInfinity)};
    return hull;
}

/// `offset` is the point as seen from the place.
KERNEL void addPoint(INOUT(Hull) hull, vec2 offset) {
    const float ratio = offset.x / offset.y;
    const bool above = offset.y >= 0.0f;
    hull.upper = above ? vec2(min(hull.upper.x, ratio), max(hull.upper.y, ratio)) : hull.upper;
    hull.lower = above ? hull.lower : vec2(min(hull.lower.x, ratio), max(hull.lower.y, ratio));
}

KERNEL bool surrounds(IN(Hull) hull) {
    return hull.upper.y > hull.lower.x && hull.upper.x < hull.lower.y;
}

SLANT_SHARED_END
#endif

// Apparent surfaces around an output.
#ifndef SLANT_LIB_SURFACE_GLSL
#define SLANT_LIB_SURFACE_GLSL
#include "lib/candidate.glsl"
#include "shared/reconstruct.h"

SLANT_SHARED_BEGIN

/// What is known about an apparent surface around an output.
struct Surface {
    int count; // samples within twice the base radius
    float slopeMax;
    float slopeSum;          // with the inner weights
    vec3 innerSum, outerSum; // tents over the base radius and over twice that
    float innerWeight, outerWeight;
    Hull hull;
};

KERNEL Surface noSurface() {
    const Surface surface = {0, -kInfinity, 0.0f, vec3(0.0f), vec3(0.0f), 0.0f, 0.0f, noHull()};
    return surface;
}

/// In a tent over the base radius.
KERNEL float innerWeightOf(IN(Candidate) candidate, float baseRadius) {
    return candidate.weight * max(1.0f - sqrt(candidate.distance2) / baseRadius, 0.0f);
}

KERNEL void addSample(INOUT(Surface) surface, IN(Candidate) candidate, float baseRadius) {
    const vec3 rgb = vec3(candidate.value);
    const float distance_ = sqrt(candidate.distance2) / baseRadius;
    const float inner = candidate.weight * max(1.0f - distance_, 0.0f);
    const float outer = candidate.weight * (2.0f - distance_);
    surface.count += 1;
    surface.slopeMax = max(surface.slopeMax, candidate.slope);
    surface.innerSum += inner * rgb;
    surface.innerWeight += inner;
    surface.slopeSum += inner * candidate.slope;
    surface.outerSum += outer * rgb;
    surface.outerWeight += outer;
    addPoint(surface.hull, candidate.offset);
}

KERNEL vec3 meanOf(IN(Surface) s) {
    return s.innerWeight > 0.0f ? s.innerSum / s.innerWeight : s.outerSum / s.outerWeight;
}

/// Surfaces composited over one another, front to back.
struct Composite {
    vec3 rgb;
    float transmittance;
};

/// A surface hides what is behind if its samples surround the output and are as many as inside a surface,
/// not as at its rim.
KERNEL bool isSolid(IN(Surface) s, float fullWeight) {
    const float fullOuterWeight = 8.0f * fullWeight; // tent twice as wide, and twice as high
    return surrounds(s.hull) && s.outerWeight >= kSolidOuter * fullOuterWeight;
}

/// Adds a surface that has another one behind it. Where it is not solid, its coverage is in proportion to
/// its number of samples: a rim, or an object smaller than R, keeps its area on average and so its
/// brightness.
KERNEL void addSurface(INOUT(Composite) composite, IN(Surface) s, float fullWeight) {
    const float opacity = isSolid(s, fullWeight) ? 1.0f : min(s.innerWeight / fullWeight, 1.0f);
    if (opacity > 0.0f) composite.rgb += composite.transmittance * opacity * meanOf(s);
    composite.transmittance *= 1.0f - opacity;
}

SLANT_SHARED_END
#endif

// Apparent surfaces around an output. As host/reconstruct/search.cpp.
#ifndef SLANT_LIB_SURFACE_GLSL
#define SLANT_LIB_SURFACE_GLSL
#include "lib/candidate.glsl"

struct Surface {
    int count;
    float slopeMax;
    float slopeSum; // with the inner weights
    vec3 innerSum, outerSum; // tents over the base radius and over twice that
    float innerWeight, outerWeight;
    Hull hull;
};

Surface noSurface() {
    return Surface(0, -kInfinity, 0.0, vec3(0.0), vec3(0.0), 0.0, 0.0, noHull());
}

void addSample(inout Surface surface, Candidate candidate, float baseRadius) {
    const vec3 rgb = candidate.value.rgb;
    const float distance_ = sqrt(candidate.distance2) / baseRadius;
    const float inner = candidate.weight * max(1.0 - distance_, 0.0), outer = candidate.weight * (2.0 - distance_);
    surface.count += 1;
    surface.slopeMax = max(surface.slopeMax, candidate.slope);
    surface.innerSum += inner * rgb;
    surface.innerWeight += inner;
    surface.slopeSum += inner * candidate.slope;
    surface.outerSum += outer * rgb;
    surface.outerWeight += outer;
    addPoint(surface.hull, candidate.offset);
}

vec3 meanOf(Surface s) { return s.innerWeight > 0.0 ? s.innerSum / s.innerWeight : s.outerSum / s.outerWeight; }

/// Surfaces laid over one another, front to back.
struct Layers {
    vec3 rgb;
    float transmittance;
};

/// A surface whose samples surround the output, and as many as if it lay inside and not at the rim, hides what is
/// behind.
bool isSolid(Surface s, float fullWeight) {
    const float fullOuterWeight = 8.0 * fullWeight; // tent twice as wide, and twice as high
    return surrounds(s.hull) && s.outerWeight >= kSolidOuter * fullOuterWeight;
}

/// Adds a surface that has another one behind it.
void addSurface(inout Layers layers, Surface s, float fullWeight) {
    const float opacity = isSolid(s, fullWeight) ? 1.0 : min(s.innerWeight / fullWeight, 1.0);
    if (opacity > 0.0) layers.rgb += layers.transmittance * opacity * meanOf(s);
    layers.transmittance *= 1.0 - opacity;
}
#endif

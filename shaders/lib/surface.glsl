// Apparent surfaces around an output. As host/reconstruct/search.cpp.
#ifndef SLANT_LIB_SURFACE_GLSL
#define SLANT_LIB_SURFACE_GLSL
#include "lib/candidate.glsl"

struct Surface {
    int count;
    float slopeMax;
    vec3 innerSum, outerSum; // tents over the base radius and over twice that
    float innerWeight, outerWeight;
    vec2 upper; // least and greatest x/y of samples with y >= 0
    vec2 lower; // ... with y < 0
};

Surface noSurface() {
    return Surface(0, -kInfinity, vec3(0.0), vec3(0.0), 0.0, 0.0, vec2(kInfinity, -kInfinity),
                   vec2(kInfinity, -kInfinity));
}

void addSample(inout Surface surface, Candidate candidate, vec3 rgb, float baseRadius) {
    const float distance_ = sqrt(candidate.distance2) / baseRadius;
    const float inner = max(1.0 - distance_, 0.0), outer = 2.0 - distance_;
    surface.count += 1;
    surface.slopeMax = max(surface.slopeMax, candidate.slope);
    surface.innerSum += inner * rgb;
    surface.innerWeight += inner;
    surface.outerSum += outer * rgb;
    surface.outerWeight += outer;
    const float ratio = candidate.offset.x / candidate.offset.y;
    if (candidate.offset.y >= 0.0)
        surface.upper = vec2(min(surface.upper.x, ratio), max(surface.upper.y, ratio));
    else
        surface.lower = vec2(min(surface.lower.x, ratio), max(surface.lower.y, ratio));
}

/// The output lies inside the hull of the surface's samples, at least one of them within the base radius.
bool covers(Surface s) {
    return s.innerWeight > 0.0 && s.upper.y > s.lower.x && s.upper.x < s.lower.y;
}
#endif

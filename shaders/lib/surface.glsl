// Apparent surfaces around an output. As host/reconstruct/search.cpp.
#ifndef SLANT_LIB_SURFACE_GLSL
#define SLANT_LIB_SURFACE_GLSL
#include "lib/candidate.glsl"

struct Surface {
    int count;
    float slopeMax;
    vec3 innerSum, outerSum; // tents over the base radius and over twice that
    float innerWeight, outerWeight;
    Hull hull;
};

Surface noSurface() {
    return Surface(0, -kInfinity, vec3(0.0), vec3(0.0), 0.0, 0.0, noHull());
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
    addPoint(surface.hull, candidate.offset);
}

/// The output lies inside the hull of the surface's samples, at least one of them within the base radius.
bool covers(Surface s) { return s.innerWeight > 0.0 && surrounds(s.hull); }
#endif

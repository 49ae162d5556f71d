// A sample seen from an output's lens position. As host/reconstruct/search.cpp.
#ifndef SLANT_LIB_CANDIDATE_GLSL
#define SLANT_LIB_CANDIDATE_GLSL

#include "shared/reconstruct.h"

#define kInfinity uintBitsToFloat(0x7f800000u)

struct Candidate {
    vec2 offset; // from the output, pixels
    float distance2; // as if its own radius were that of the search
    float slope;
    float weight; // see lib/occlusion.glsl
    vec4 value; // rgb; R over its own radius
};

/// Whether an output lies inside the convex hull of samples.
struct Hull {
    vec2 upper; // least and greatest x/y of samples with y >= 0
    vec2 lower; // ... with y < 0
};

Hull noHull() { return Hull(vec2(kInfinity, -kInfinity), vec2(kInfinity, -kInfinity)); }

void addPoint(inout Hull hull, vec2 offset) {
    const float ratio = offset.x / offset.y;
    const bool above = offset.y >= 0.0;
    hull.upper = above ? vec2(min(hull.upper.x, ratio), max(hull.upper.y, ratio)) : hull.upper;
    hull.lower = above ? hull.lower : vec2(min(hull.lower.x, ratio), max(hull.lower.y, ratio));
}

bool surrounds(Hull hull) { return hull.upper.y > hull.lower.x && hull.upper.x < hull.lower.y; }
#endif

// Apparent surfaces around an output. As shaders/lib/surface.glsl.
#pragma once
#include "reconstruct/candidates.h"
#include "reconstruct/hull.h"

#include <limits>

namespace slant {

/// What is known of an apparent surface around an output.
struct Surface {
    int count = 0; ///< samples within twice the base radius
    float slopeMax = -std::numeric_limits<float>::infinity();
    float slopeSum = 0;            ///< with the inner weights
    vec3 innerSum{0}, outerSum{0}; ///< tents over the base radius and over twice that
    float innerWeight = 0, outerWeight = 0;
    Hull hull;
};

inline void addSample(Surface& surface, const Candidate& candidate, float baseRadius) {
    const vec3 rgb(candidate.value);
    const float distance = glm::sqrt(candidate.distance2) / baseRadius;
    const float inner = candidate.weight * glm::max(1 - distance, 0.f),
                outer = candidate.weight * (2 - distance);
    surface.count += 1;
    surface.slopeMax = glm::max(surface.slopeMax, candidate.slope);
    surface.innerSum += inner * rgb;
    surface.innerWeight += inner;
    surface.slopeSum += inner * candidate.slope;
    surface.outerSum += outer * rgb;
    surface.outerWeight += outer;
    addPoint(surface.hull, candidate.offset);
}

inline vec3 meanOf(const Surface& s) {
    return s.innerWeight > 0 ? s.innerSum / s.innerWeight : s.outerSum / s.outerWeight;
}

/// A surface whose samples surround the output, and as many as if it lay inside and not at the rim, hides
/// what is behind.
inline bool isSolid(const Surface& s, float fullWeight) {
    const float fullOuterWeight = 8 * fullWeight; // tent twice as wide, and twice as high
    return surrounds(s.hull) && s.outerWeight >= kSolidOuter * fullOuterWeight;
}

} // namespace slant

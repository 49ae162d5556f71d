// Whether a place lies inside the convex hull of points, one at a time: it does where, seen from it, those
// above span directions beyond those below on both sides. As shaders/lib/candidate.glsl.
#pragma once
#include "shared/types.h"

#include <limits>

namespace slant {

struct Hull {
    vec2 upper{std::numeric_limits<float>::infinity(),
               -std::numeric_limits<float>::infinity()}; ///< least and greatest x/y of points with y >= 0
    vec2 lower = upper;                                  ///< ... with y < 0
};

/// `offset` is the point as seen from the place.
inline void addPoint(Hull& hull, vec2 offset) {
    const float ratio = offset.x / offset.y;
    if (offset.y >= 0)
        hull.upper = vec2(glm::min(hull.upper.x, ratio), glm::max(hull.upper.y, ratio));
    else
        hull.lower = vec2(glm::min(hull.lower.x, ratio), glm::max(hull.lower.y, ratio));
}

inline bool surrounds(const Hull& hull) {
    return hull.upper.y > hull.lower.x && hull.upper.x < hull.lower.y;
}

} // namespace slant

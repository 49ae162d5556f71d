// What the shadow rays of a texel are.
//
// Needs, declared before the include: rayAt(uint), as lib/soft_shadows.glsl does. In C++ it is included in a
// struct that has it, after lib/shading.glsl.
#include "lib/shading.glsl"

/// Of the records [begin, end), those of the texel.
KERNEL uint raysBetween(uint begin, uint end) {
    uint rays = 0u;
    if (end - begin > kMaxShadowRays) return rays;
    for (uint i = begin; i < end; ++i) {
        const float share = rayAt(i).w;
        if (share > 0.0f) rays |= share < kUnblocked ? kSomeBlocked : kSomeUnblocked;
    }
    return rays;
}

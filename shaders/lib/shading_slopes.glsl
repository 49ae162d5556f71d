// How the nearness of a surfel changes along its surface: from the surfels beside it.
//
// Needs, declared before the include: geometryAt(int), normal and nearness of a surfel. In C++ it is included
// in a struct that has that, after lib/shading.glsl.
#include "lib/shading.glsl"

/// Per texel along x or y, whichever `step_` goes.
KERNEL float slopeAlong(int surfel, ivec2 size, ivec2 step_) {
    const int texel = surfel / kSurfels;
    const ivec2 place = ivec2(texel % size.x, texel / size.x);
    IN(vec4) center = geometryAt(surfel);
    float found[2] = {kInfinity, kInfinity};
    for (int side = 0; side < 2; ++side) {
        const float sign_ = side == 0 ? -1.0f : 1.0f;
        const ivec2 at = side == 0 ? place - step_ : place + step_;
        if (at.x < 0 || at.y < 0 || at.x >= size.x || at.y >= size.y) continue;
        for (int layer = 0; layer < kSurfels; ++layer) {
            IN(vec4) other = geometryAt((at.y * size.x + at.x) * kSurfels + layer);
            if (!(other.w > 0.0f) || 1.0f - cosineOf(center, other) > kApartNormals) continue;
            if (abs(other.w - center.w) > kSteepest * max(other.w, center.w)) continue;
            const float slope = sign_ * (other.w - center.w);
            if (abs(slope) < abs(found[side])) found[side] = slope;
        }
    }
    return smaller(found[0], found[1]);
}

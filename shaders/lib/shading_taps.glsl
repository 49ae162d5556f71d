// The neighbours of a surfel, as shading_bands and shading_gains weigh them.
//
// Needs, declared before the include: geometryAt(int), normal and nearness of a surfel; slopesAt(int), how
// its nearness changes per pixel; a struct Taps; and tap(int, float, inout Taps), which takes a surfel by its
// weight. In C++ it is included in a struct that has these, after lib/shading.glsl.
#include "lib/shading.glsl"

/// Takes the surfels of the 3x3 texels around, `stride` apart, that are like one, by a tent times likeness.
KERNEL void forEachTap(int surfel, ivec2 size, int stride, INOUT(Taps) taps) {
    const int texel = surfel / kSurfels;
    const ivec2 place = ivec2(texel % size.x, texel / size.x);
    IN(vec4) center = geometryAt(surfel);
    const vec2 slopes = slopesAt(surfel);
    for (int i = 0; i < 9; ++i) {
        const ivec2 steps = ivec2(i % 3 - 1, i / 3 - 1), at = place + steps * stride;
        if (at.x < 0 || at.y < 0 || at.x >= size.x || at.y >= size.y) continue;
        const float tent = (steps.x == 0 ? 0.5f : 0.25f) * (steps.y == 0 ? 0.5f : 0.25f);
        if (i == 4) {
            tap(surfel, tent, taps);
            continue;
        }
        for (int layer = 0; layer < kSurfels; ++layer) {
            const int other = (at.y * size.x + at.x) * kSurfels + layer;
            IN(vec4) geometry = geometryAt(other);
            if (!(geometry.w > 0.0f)) continue;
            const float weight = tent * likeness(center, slopes, geometry, vec2(steps * stride));
            if (weight > 0.0f) tap(other, weight, taps);
        }
    }
}

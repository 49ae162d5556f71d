// The light of a surfel filtered over its neighbours.
//
// Needs, declared before the include: kReflects; geometryAt(int) and slopesAt(int), as lib/shading_taps.glsl
// does; and lightSumAt(int), by lightIndex. In C++ it is included in a struct that has these, after
// lib/shading.glsl.
#include "lib/shading.glsl"

struct Taps {
    vec4 light[4]; // of both parts, of both halves: sums and counts
};

KERNEL Taps noTaps() {
    const Taps taps = {{vec4(0.0f), vec4(0.0f), vec4(0.0f), vec4(0.0f)}};
    return taps;
}

KERNEL void tap(int surfel, float weight, INOUT(Taps) taps) {
    for (int part = 0; part < (kReflects ? 2 : 1); ++part) {
        const int sums = lightIndex(surfel, part, 0, kReflects);
        taps.light[2 * part] += weight * lightSumAt(sums);
        taps.light[2 * part + 1] += weight * lightSumAt(sums + 1);
    }
}
#include "lib/shading_taps.glsl"

KERNEL Taps filtered(int surfel, ivec2 size, int stride) {
    Taps taps = noTaps();
    forEachTap(surfel, size, stride, taps);
    return taps;
}

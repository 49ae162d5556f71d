// Powers of a band, and of the one before, averaged over the neighbours of a surfel.
//
// Needs, declared before the include: kReflects; geometryAt(int) and slopesAt(int), as lib/shading_taps.glsl
// does; and powersAt(int), of each part of a surfel: covariance and variance of the band, and, averaged
// once, of the one before. In C++ it is included in a struct that has these, after lib/shading.glsl.
#include "lib/shading.glsl"

struct Taps {
    vec4 powers[2]; // of both parts
    float weight;
};

KERNEL void tap(int surfel, float weight, INOUT(Taps) taps) {
    const int parts = kReflects ? 2 : 1;
    for (int part = 0; part < parts; ++part) taps.powers[part] += weight * powersAt(surfel * parts + part);
    taps.weight += weight;
}
#include "lib/shading_taps.glsl"

KERNEL Taps averaged(int surfel, ivec2 size, int stride) {
    Taps taps = {{vec4(0.0f), vec4(0.0f)}, 0.0f};
    forEachTap(surfel, size, stride, taps);
    return taps;
}

// An output, and the entries of the pattern that outputs are made from, for C++ and GLSL.
#ifndef SLANT_SHARED_OUTPUT_H
#define SLANT_SHARED_OUTPUT_H
#include "shared/types.h"

SLANT_SHARED_BEGIN

/// One output: where it lies in pixel, lens and time.
struct Output {
    vec2 xy; // raster position
    vec2 uv; // in the disc of radius lensScale, where the aperture is open
    float t;
    float positionCode; // place in its pixel: qx * kSubpixels + qy, exact in a float

    // On the film's side false, 1, the unit matrix and (1, 1); set by toSceneSide.
    bool onSceneSide;
    float weight;    // of the radiance
    vec3 filmMetric; // as of SceneRay
    vec2 extent;
};

/// Lens cell of an entry of the output pattern: column, row.
SLANT_SHARED_FUNCTION uvec2 lensCell(uvec4 entry) {
    return uvec2(entry.w & 255u, entry.w >> 16);
}

/// Which output of a group comes in the place of this one in the group's order.
SLANT_SHARED_FUNCTION int inOrder(uvec4 entry) {
    return int(entry.w >> 8 & 255u);
}

SLANT_SHARED_END

#endif

// What C++ and GLSL share of the filter of shading (host/reconstruct/shading_filter.h).
#ifndef SLANT_SHARED_SHADING_H
#define SLANT_SHARED_SHADING_H
#include "shared/reconstruct.h"

SLANT_SHARED_BEGIN

/// Surfaces that a texel keeps apart.
SLANT_SHARED_CONSTANT int kSurfels = 2;
/// Bands of detail: the coarsest filter reaches 15 pixels to each side. A fifth band changes nothing.
SLANT_SHARED_CONSTANT int kShadingBands = 4;
/// Samples are of different surfaces where 1 - cos of the angle between their normals over the first, and
/// the difference of their nearness relative to it over the second, add up to more than 1. Half or thrice
/// these change errors by a few percent.
SLANT_SHARED_CONSTANT float kApartNormals = 0.1f;
SLANT_SHARED_CONSTANT float kApartDepths = 0.05f;
/// Neighbours are of one plane while their nearness differs from that of the plane by less than this part of
/// it, plus this part of what the plane itself changes on the way.
SLANT_SHARED_CONSTANT float kPlaneSlack = 0.01f;
SLANT_SHARED_CONSTANT float kSlantSlack = 0.5f;
/// A plane does not come nearer by more than this part in a pixel: what does is another surface.
SLANT_SHARED_CONSTANT float kSteepest = 0.1f;
/// Detail with less than this power, relative to the square of what it stands on, is not noise.
SLANT_SHARED_CONSTANT float kNoNoise = 1e-12f;
/// Surfel of a sample that has none.
SLANT_SHARED_CONSTANT uint kNoSurfel = 0xffffffffu;

/// Texels of pinhole position, a pixel wide.
struct ShadingLayout {
    ivec2 origin; // pixel
    ivec2 size;   // pixels
};

/// shading_texels.
struct TexelPush {
    ShadingLayout texels;
    uint count; // records
};

/// shading_surfels, shading_slopes, shading_bands, shading_gains.
struct ShadingPush {
    ivec2 size;
    int band; // 0 is the finest
};

/// shading_apply.
struct ShadedPush {
    ivec2 size;
    int firstRow, lastRow; // texels whose samples are changed: from the first up to before the last
    uint count;            // records
};

SLANT_SHARED_END

#endif

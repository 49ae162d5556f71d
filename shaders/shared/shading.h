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
/// A sample looks along so many lines to lights, its own shadow ray among them. Half as many leave 4 % more
/// error, and mottle penumbras.
SLANT_SHARED_CONSTANT int kShadowLines = 16;
/// It looks for rays in the texels so many to each side, fewer where there are more rays than that, and not
/// at all where there are more in its own texel alone: by then the noise is little and the work much. A
/// narrower window leaves a fifth more error, a wider one 3 % less.
SLANT_SHARED_CONSTANT int kShadowReach = 2;
SLANT_SHARED_CONSTANT uint kMaxShadowRays = 160u;
SLANT_SHARED_CONSTANT uint kMaxOwnShadowRays = 40u;
/// Where less than this share of a window is of one surface, shadows are not known well enough: there is
/// little to gain, at the same price.
SLANT_SHARED_CONSTANT float kFewestShadowRays = 0.5f;
/// Neighbours lie in directions with at most this sine over the surface; samples of a texel with normals of
/// at least this cosine see the same neighbours.
SLANT_SHARED_CONSTANT float kShadowCosine = 0.9f;
SLANT_SHARED_CONSTANT float kShadowSine = 0.2f;
/// Where receivers move the ends of lines past the nearest blocker by less than this part (squared) of what
/// the rays' own ends do, penumbras are wider than windows: there each half of the samples sees its own rays,
/// so that the bands can average what their lines have in common with those of neighbours.
SLANT_SHARED_CONSTANT float kWidePenumbra = 0.02f;
/// Share of the way to the light that is said of a ray with nothing in its way.
SLANT_SHARED_CONSTANT float kUnblocked = 2.0f;
/// What a texel's rays are: something is in the way of one, of none.
SLANT_SHARED_CONSTANT uint kSomeBlocked = 1u;
SLANT_SHARED_CONSTANT uint kSomeUnblocked = 2u;

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

/// shading_rays, shading_shadows, shading_surfels, shading_slopes, shading_bands, shading_gains.
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

// How many samples a pixel lie around a place on a surface. As host/reconstruct/density.cpp, where it is explained.
// Needs sumAt(uint), declared before the include.
#ifndef SLANT_LIB_DENSITY_GLSL
#define SLANT_LIB_DENSITY_GLSL
#include "shared/reconstruct.h"

uint sumTo(DensityLayout layout_, float x, float y) { return sumAt(uint(y) * uint(layout_.size.x + 1) + uint(x)); }

float samplesAround(DensityLayout layout_, vec2 p, float slope) {
    const float halfPx = max(kHalfSquareOfDisc * abs(slope), kMinHalfPx);
    const vec2 place = p - vec2(layout_.origin), size = vec2(layout_.size);
    const vec2 low = clamp(floor(place - halfPx + 0.5), vec2(0.0), size - 1.0);
    const vec2 high = clamp(floor(place + halfPx + 0.5), low + 1.0, size);
    const uint count = (sumTo(layout_, high.x, high.y) - sumTo(layout_, low.x, high.y)) -
                       (sumTo(layout_, high.x, low.y) - sumTo(layout_, low.x, low.y));
    return max(float(count) / ((high.x - low.x) * (high.y - low.y)), kMinDensity);
}

float radiusRatioAt(DensityLayout layout_, vec2 p, float slope, float radiusPx) {
    if (layout_.size.x == 0) return 1.0;
    return max(sqrt(samplesAround(layout_, p, slope)) * (radiusPx / kSearchRadius), 1.0);
}
#endif

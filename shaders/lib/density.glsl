// How many samples per pixel lie around a place on a surface, which host/reconstruct/density.h explains.
//
// Needs, declared before the include: sumAt(uint), which reads the sums. In C++ it is included in a struct
// that has that.
#include "shared/kernel.h"
#include "shared/reconstruct.h"

KERNEL uint sumTo(IN(DensityLayout) layout_, float x, float y) {
    return sumAt(uint(y) * uint(layout_.size.x + 1) + uint(x));
}

/// For pixels that differ in their number of samples.
KERNEL float samplesAround(IN(DensityLayout) layout_, vec2 p, float slope) {
    const float halfPx = max(kHalfSquareOfDisc * abs(slope), kMinHalfPx);
    const vec2 place = p - vec2(layout_.origin), size = vec2(layout_.size);
    const vec2 low = clamp(floor(place - halfPx + 0.5f), vec2(0.0f), size - 1.0f);
    const vec2 high = clamp(floor(place + halfPx + 0.5f), low + 1.0f, size);
    const uint count = (sumTo(layout_, high.x, high.y) - sumTo(layout_, low.x, high.y)) -
                       (sumTo(layout_, high.x, low.y) - sumTo(layout_, low.x, low.y));
    return max(float(count) / ((high.x - low.x) * (high.y - low.y)), kMinDensity);
}

/// R over the own radius of a sample: never below 1, and 1 if all pixels have equally many samples.
KERNEL float radiusRatioAt(IN(DensityLayout) layout_, vec2 p, float slope, float radiusPx) {
    if (layout_.size.x == 0) return 1.0f;
    return max(sqrt(samplesAround(layout_, p, slope)) * (radiusPx / kSearchRadius), 1.0f);
}

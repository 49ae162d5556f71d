// The Gaussian, from + and * alone so that all devices give the same bits.
#ifndef SLANT_LIB_GAUSSIAN_GLSL
#define SLANT_LIB_GAUSSIAN_GLSL
#include "shared/kernel.h"

SLANT_SHARED_BEGIN

/// e^-x for 0 <= x <= 80, within 3 ulp.
KERNEL float expOfMinus(float x) {
    // x = n ln 2 + r: e^-x = 2^-n e^-r, ln 2 in two parts of which the first times n is exact.
    const float n = floor(x * 1.44269504f + 0.5f);
    const float r = (x - n * 0.693145752f) - n * 1.42860677e-6f;
    const float series =
        1.0f +
        r * (-1.0f + r * (0.5f + r * (-0.166666667f +
                                      r * (0.0416666667f + r * (-0.00833333333f + r * 0.00138888889f)))));
    return series * uintBitsToFloat(uint(127 - int(n)) << 23);
}

SLANT_SHARED_END
#endif

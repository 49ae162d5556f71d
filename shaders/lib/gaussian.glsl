// The Gaussian, from + and * alone so that the CPU gives the same bits. As host/reconstruct/window.cpp.
#ifndef SLANT_LIB_GAUSSIAN_GLSL
#define SLANT_LIB_GAUSSIAN_GLSL

/// e^-x for 0 <= x <= 80.
float expOfMinus(float x) {
    const float n = floor(x * 1.44269504 + 0.5);
    const float r = (x - n * 0.693145752) - n * 1.42860677e-6;
    const float series =
        1.0 +
        r * (-1.0 + r * (0.5 + r * (-0.166666667 + r * (0.0416666667 + r * (-0.00833333333 + r * 0.00138888889)))));
    return series * uintBitsToFloat(uint(127 - int(n)) << 23);
}
#endif

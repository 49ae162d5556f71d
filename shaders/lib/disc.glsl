// The concentric map between square and disc, and its polar coordinates.
#ifndef SLANT_LIB_DISC_GLSL
#define SLANT_LIB_DISC_GLSL
#include "shared/kernel.h"

SLANT_SHARED_BEGIN

SLANT_SHARED_CONSTANT float kLastBelowOne = 0.99999994f;

/// Shirley and Chiu's concentric map from [-1, 1]^2 to the unit disc. Sine and cosine are polynomials, as
/// those of libraries differ between processors.
KERNEL vec2 concentricDisc(vec2 square) {
    const float a = square.x, b = square.y;
    if (a == 0.0f && b == 0.0f) return vec2(0.0f);
    const bool wide = abs(a) > abs(b);
    const float r = wide ? a : b;
    const float q = wide ? b / a : a / b;
    const float x = q * 0.785398163f;
    const float z = x * x;
    const float sine =
        x * (1.0f + z * (-0.166666667f + z * (0.00833333333f + z * (-0.000198412698f + z * 2.75573192e-6f))));
    const float cosine =
        1.0f + z * (-0.5f + z * (0.0416666667f + z * (-0.00138888889f + z * 2.48015873e-5f)));
    return wide ? vec2(r * cosine, r * sine) : vec2(r * sine, r * cosine);
}

/// Of a place of the square [-1, 1]^2 in the concentric map: distance from the centre, angle in turns from
/// (1, 0) towards (0, 1), below 1.
struct Polar {
    float distance, turn;
};

KERNEL Polar polarOf(vec2 square) {
    const bool wide = abs(square.x) > abs(square.y);
    const float radius = wide ? square.x : square.y;
    Polar polar = {0.0f, 0.0f};
    if (radius == 0.0f) return polar;
    float turn = wide ? square.y / square.x * 0.125f : 0.25f - square.x / square.y * 0.125f;
    if (radius < 0.0f) turn += 0.5f;
    if (turn < 0.0f) turn += 1.0f;
    polar.distance = abs(radius);
    polar.turn = min(turn, kLastBelowOne);
    return polar;
}

/// The inverse of it.
KERNEL vec2 squareOf(IN(Polar) polar) {
    const float side = floor(4.0f * polar.turn + 0.5f), along = 8.0f * polar.turn - 2.0f * side;
    const vec2 place = side == 1.0f   ? vec2(-along, 1.0f)
                       : side == 2.0f ? vec2(-1.0f, -along)
                       : side == 3.0f ? vec2(along, -1.0f)
                                      : vec2(1.0f, along);
    return polar.distance * place;
}

SLANT_SHARED_END
#endif

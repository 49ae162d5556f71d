// Lens positions by the shape of the aperture. As host/camera/aperture.cpp and disc.h, where it is explained.
//
// Needs, declared before the include: apertureAt(int), which reads Aperture::table().
#ifndef SLANT_LIB_APERTURE_GLSL
#define SLANT_LIB_APERTURE_GLSL

const int kApertureSide = 256;           // ApertureShape::kSide
const float kLastBelowOne = 0.99999994;

/// Shirley and Chiu's concentric map from [-1, 1]^2 to the unit disc.
vec2 concentricDisc(vec2 square) {
    const float a = square.x, b = square.y;
    if (a == 0.0 && b == 0.0) return vec2(0.0);
    const bool wide = abs(a) > abs(b);
    const float r = wide ? a : b;
    const float q = wide ? b / a : a / b;
    const float x = q * 0.785398163;
    const float z = x * x;
    const float sine =
        x * (1.0 + z * (-0.166666667 + z * (0.00833333333 + z * (-0.000198412698 + z * 2.75573192e-6))));
    const float cosine =
        1.0 + z * (-0.5 + z * (0.0416666667 + z * (-0.00138888889 + z * 2.48015873e-5)));
    return wide ? vec2(r * cosine, r * sine) : vec2(r * sine, r * cosine);
}

vec2 apertureCorner(int i) { return vec2(apertureAt(1 + 2 * i), apertureAt(2 + 2 * i)); }

vec2 onOutline(vec2 square, int corners) {
    const bool wide = abs(square.x) > abs(square.y);
    const float radius = wide ? square.x : square.y;
    if (radius == 0.0) return vec2(0.0);
    float turn = wide ? square.y / square.x * 0.125 : 0.25 - square.x / square.y * 0.125;
    if (radius < 0.0) turn += 0.5;
    if (turn < 0.0) turn += 1.0;
    const float sector = turn * float(corners);
    const int i = min(int(sector), corners - 1);
    const vec2 begin = apertureCorner(i), end = apertureCorner(i + 1);
    return abs(radius) * (begin + (sector - float(i)) * (end - begin));
}

/// The entry of the cumulative table from `first` on that a number in [0, 1) falls into.
int entryAt(int first, float s) {
    int low = 0;
    for (int step_ = kApertureSide / 2; step_ > 0; step_ /= 2)
        if (apertureAt(first + low + step_) <= s) low += step_;
    return low;
}

float placeAt(int first, int entry, float s) {
    const float begin = apertureAt(first + entry), end = apertureAt(first + entry + 1);
    return (float(entry) + (s - begin) / (end - begin)) * (2.0 / float(kApertureSide)) - 1.0;
}

vec2 onImage(vec2 square) {
    const vec2 s = min(0.5 * square + 0.5, vec2(kLastBelowOne));
    const int row = entryAt(1, s.y);
    const int columns = 1 + (1 + row) * (kApertureSide + 1);
    return vec2(placeAt(columns, entryAt(columns, s.x), s.x), placeAt(1, row, s.y));
}

/// `square` in [-1, 1)^2.
vec2 lensPosition(vec2 square) {
    const int kind = int(apertureAt(0));
    if (kind == 0) return concentricDisc(square);
    return kind > 0 ? onOutline(square, kind) : onImage(square);
}
#endif

// Lens positions by the shape of the aperture. As host/camera/aperture.cpp and disc.h, where it is explained.
//
// Needs, declared before the include: apertureAt(int), which reads Aperture::table().
#ifndef SLANT_LIB_APERTURE_GLSL
#define SLANT_LIB_APERTURE_GLSL

const int kApertureSectors = 512, kApertureRings = 128; // as in ApertureShape
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

/// Of a place of the square [-1, 1]^2 in the concentric map: distance from the centre, angle in turns from (1, 0)
/// towards (0, 1), below 1.
struct Polar {
    float distance, turn;
};
Polar polarOf(vec2 square) {
    const bool wide = abs(square.x) > abs(square.y);
    const float radius = wide ? square.x : square.y;
    if (radius == 0.0) return Polar(0.0, 0.0);
    float turn = wide ? square.y / square.x * 0.125 : 0.25 - square.x / square.y * 0.125;
    if (radius < 0.0) turn += 0.5;
    if (turn < 0.0) turn += 1.0;
    return Polar(abs(radius), min(turn, kLastBelowOne));
}
/// The inverse of it.
vec2 squareOf(Polar polar) {
    const float side = floor(4.0 * polar.turn + 0.5), along = 8.0 * polar.turn - 2.0 * side;
    const vec2 place = side == 1.0   ? vec2(-along, 1.0)
                       : side == 2.0 ? vec2(-1.0, -along)
                       : side == 3.0 ? vec2(along, -1.0)
                                     : vec2(1.0, along);
    return polar.distance * place;
}

/// The entry of the cumulative table from `first` on that a number in [0, 1) falls into.
int entryAt(int first, int entries, float s) {
    int low = 0;
    for (int step_ = entries / 2; step_ > 0; step_ /= 2)
        if (apertureAt(first + low + step_) <= s) low += step_;
    return low;
}

float partAt(int first, int entry, float s) {
    const float begin = apertureAt(first + entry), end = apertureAt(first + entry + 1);
    return (s - begin) / (end - begin);
}

float distanceAt(int rings, float s) {
    const int ring = entryAt(rings, kApertureRings, s);
    const float inner = float(ring) * (1.0 / float(kApertureRings));
    const float outer = float(ring + 1) * (1.0 / float(kApertureRings));
    return sqrt(inner * inner + partAt(rings, ring, s) * (outer * outer - inner * inner));
}

vec2 onOutline(vec2 square, int corners) {
    const Polar polar = polarOf(square);
    const float sector = polar.turn * float(corners);
    const int i = min(int(sector), corners - 1);
    const vec2 begin = apertureCorner(i), end = apertureCorner(i + 1);
    return polar.distance * (begin + (sector - float(i)) * (end - begin));
}

vec2 onWeights(vec2 square) {
    const Polar polar = polarOf(square);
    const int sector = entryAt(1, kApertureSectors, polar.turn);
    const float turn = (float(sector) + partAt(1, sector, polar.turn)) * (1.0 / float(kApertureSectors));
    const int rings = kApertureSectors + 2 + sector * (kApertureRings + 1);
    const float light = min(polar.distance * polar.distance, kLastBelowOne);
    return concentricDisc(squareOf(Polar(distanceAt(rings, light), turn)));
}

/// `square` in [-1, 1)^2.
vec2 lensPosition(vec2 square) {
    const int kind = int(apertureAt(0));
    if (kind == 0) return concentricDisc(square);
    return kind > 0 ? onOutline(square, kind) : onWeights(square);
}
#endif

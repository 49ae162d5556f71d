// Lens positions by the shape of the aperture, which host/camera/aperture.h explains.
//
// Needs, declared before the include: apertureAt(int), which reads Aperture::table(). In C++ it is included
// in a struct that has that, after lib/disc.glsl.
#include "shared/aperture.h"
#include "lib/disc.glsl"

KERNEL vec2 apertureCorner(int i) {
    return vec2(apertureAt(1 + 2 * i), apertureAt(2 + 2 * i));
}

/// The entry of a cumulative table, from `first` on, that a number in [0, 1) falls into; `entries` is a power
/// of two.
KERNEL int entryAt(int first, int entries, float s) {
    int low = 0;
    for (int step_ = entries / 2; step_ > 0; step_ /= 2)
        if (apertureAt(first + low + step_) <= s) low += step_;
    return low;
}

/// How far into the entry, 0 to 1.
KERNEL float partAt(int first, int entry, float s) {
    const float begin = apertureAt(first + entry), end = apertureAt(first + entry + 1);
    return (s - begin) / (end - begin);
}

/// Where the cumulative light of a sector's rings begins.
KERNEL int ringsOf(int sector) {
    return kApertureSectors + 2 + sector * (kApertureRings + 1);
}

/// The distance from the centre within which the share `s` of the sector's light lies.
KERNEL float distanceAt(int rings, float s) {
    const int ring = entryAt(rings, kApertureRings, s);
    const float inner = float(ring) * (1.0f / float(kApertureRings));
    const float outer = float(ring + 1) * (1.0f / float(kApertureRings));
    return sqrt(inner * inner + partAt(rings, ring, s) * (outer * outer - inner * inner));
}

KERNEL vec2 onOutline(vec2 square, int corners) {
    const Polar polar = polarOf(square);
    const float sector = polar.turn * float(corners);
    const int i = min(int(sector), corners - 1);
    const vec2 begin = apertureCorner(i), end = apertureCorner(i + 1);
    return polar.distance * (begin + (sector - float(i)) * (end - begin));
}

KERNEL vec2 onWeights(vec2 square) {
    const Polar polar = polarOf(square);
    const int sector = entryAt(1, kApertureSectors, polar.turn);
    const float turn = (float(sector) + partAt(1, sector, polar.turn)) * (1.0f / float(kApertureSectors));
    const float light = min(polar.distance * polar.distance, kLastBelowOne);
    const Polar place = {distanceAt(ringsOf(sector), light), turn};
    return concentricDisc(squareOf(place));
}

/// `square` in [-1, 1)^2.
KERNEL vec2 lensPosition(vec2 square) {
    const int kind = int(apertureAt(0));
    if (kind == 0) return concentricDisc(square);
    return kind > 0 ? onOutline(square, kind) : onWeights(square);
}

// The filter of shading over surfels: how alike they are, bands of detail, and how much of each is kept.
#ifndef SLANT_LIB_SHADING_GLSL
#define SLANT_LIB_SHADING_GLSL
#include "shared/shading.h"
#include "shared/kernel.h"

SLANT_SHARED_BEGIN

/// Where the sum of one half of the samples (rgb, count) stands, for a part of the light: 0 is that of the
/// diffuse surface, 1 the reflection.
KERNEL int lightIndex(int surfel, int part, int half_, bool twoParts) {
    return ((twoParts ? 2 * surfel + part : surfel) << 1) + half_;
}

/// Of two normals (xyz).
KERNEL float cosineOf(IN(vec4) a, IN(vec4) b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// The texel of a pinhole position; the number of texels if it is in none.
KERNEL uint texelOf(IN(ShadingLayout) layout_, vec2 p) {
    const vec2 place = floor(p) - vec2(layout_.origin);
    const vec2 size = vec2(layout_.size);
    if (!(place.x >= 0.0f && place.y >= 0.0f && place.x < size.x && place.y < size.y))
        return uint(layout_.size.x) * uint(layout_.size.y);
    return uint(place.y) * uint(layout_.size.x) + uint(place.x);
}

/// How unlike two samples are, by their normals (xyz) and nearness (w); over 1 they are of different
/// surfaces.
KERNEL float unlikeness(IN(vec4) a, IN(vec4) b) {
    return (1.0f - cosineOf(a, b)) / kApartNormals + abs(a.w - b.w) / (kApartDepths * max(a.w, b.w));
}

/// How much a surfel counts for another, 0 to 1; `slopes`: how nearness changes along the plane of `a`, per
/// pixel; `offset`: from there to b, in pixels.
KERNEL float likeness(IN(vec4) a, vec2 slopes, IN(vec4) b, vec2 offset) {
    const float ofNormals = max(1.0f - (1.0f - cosineOf(a, b)) / kApartNormals, 0.0f);
    const float off = abs(b.w - a.w - (slopes.x * offset.x + slopes.y * offset.y));
    const float slack =
        kPlaneSlack * a.w + kSlantSlack * (abs(slopes.x * offset.x) + abs(slopes.y * offset.y));
    return ofNormals * ofNormals * max(1.0f - off / slack, 0.0f);
}

/// The better of two differences of nearness along an axis, of neighbours that may not be of one surface
/// (kInfinity then): the smaller.
KERNEL float smaller(float before, float after) {
    const float least = abs(before) < abs(after) ? before : after;
    return isinf(least) ? 0.0f : least;
}

/// The light of a surfel from sums of the halves of its samples.
KERNEL vec3 meanOf(IN(vec4) sum) {
    return sum.w > 0.0f ? vec3(sum) / sum.w : vec3(0.0f);
}
KERNEL float squareOf(vec3 v) {
    return v.x * v.x + v.y * v.y + v.z * v.z;
}

/// One band of a surfel: what a finer filter shows and a coarser one does not.
struct Band {
    vec3 detail; // of all samples
    // Of the details of the two halves of the samples, relative to the square of what the coarser one shows.
    float covariance, variance;
};

KERNEL Band bandOf(IN(vec4) fine0, IN(vec4) fine1, IN(vec4) coarse0, IN(vec4) coarse1) {
    const vec3 base = meanOf(coarse0 + coarse1);
    Band band = {meanOf(fine0 + fine1) - base, 0.0f, 0.0f};
    const float base2 = squareOf(base);
    if (!(fine0.w > 0.0f && fine1.w > 0.0f && base2 > 1e-30f)) return band;
    const vec3 a = meanOf(fine0) - meanOf(coarse0), b = meanOf(fine1) - meanOf(coarse1);
    band.covariance = (a.x * b.x + a.y * b.y + a.z * b.z) / base2;
    band.variance = 0.5f * (squareOf(a) + squareOf(b)) / base2;
    return band;
}

/// How much of a band is kept, from both powers averaged around the surfel. Their quotient is the correlation
/// of the halves, signal / (signal + noise); the mean of both halves has half the noise, of which Wiener's
/// filter keeps signal / (signal + noise / 2).
KERNEL float keptShare(float covariance, float variance) {
    if (!(variance > kNoNoise)) return 1.0f;
    const float correlation = max(covariance / variance, 0.0f);
    return 2.0f * correlation / (1.0f + correlation);
}

/// What filteredLight takes, with one more band: `first` is the finest.
KERNEL vec4 changedBy(IN(vec4) before, vec3 detail, float kept, bool first) {
    const vec3 change = (kept - 1.0f) * detail;
    return first ? vec4(change, kept) : vec4(vec3(before) + change, before.w);
}

/// The light of a sample from what the filter found at its surfel: `change` of the mean of its samples, and
/// the share (w) of the finest band that is kept, which a sample's own deviation from that mean is taken for.
KERNEL vec3 filteredLight(vec3 light, IN(vec4) mean, IN(vec4) change) {
    return max(light + vec3(change) + (change.w - 1.0f) * (light - vec3(mean)), vec3(0.0f));
}

/// Whether the samples of a surfel are to be changed.
KERNEL bool isShaded(uint surfel, IN(ShadedPush) push) {
    if (surfel == kNoSurfel) return false;
    const int row = int(surfel) / kSurfels / push.size.x;
    return row >= push.firstRow && row < push.lastRow;
}

SLANT_SHARED_END
#endif

// The light field: the contract between whoever traces samples and whoever reconstructs an image from them.
#pragma once
#include "base/rect.h"
#include "camera/aperture.h"
#include "camera/lens_map.h"
#include "camera/slope_model.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace slant {

/// One sample of the light field: the ray through raster position (x, y), lens position (u, v) at shutter
/// time t, and where it ended. Eight floats, two texels: uploaded as they are. What was seen there stands in
/// planes of values beside the samples (SampleSet).
///
/// - x, y: raster position in pixels, y downwards; pixel (i, j) covers [i, i+1) x [j, j+1).
/// - u, v: lens position in the unit disc, in raster orientation: u to the right, v downwards, so that a
///   fixed point of slope s is seen at x + (u' - u) s, y + (v' - v) s from lens position (u', v').
/// - t: shutter time in [0, 1).
/// - w: camera-space depth > 0 along the viewing axis; +infinity where nothing was hit.
/// - slope: pixels per lens radius, for a thin lens C1/w + C2 with C1 < 0: the nearer, the smaller.
/// - alpha: 1 where something was hit, else 0.
///
/// Through a compound lens x, y and u, v are on the film's side (camera/lens_map.h), but points move like
/// this on the scene's side.
///
/// A point that moves in time moves along a straight line in homogeneous coordinates, as perspective has it.
/// With its pinhole position p = (x, y) - slope (u, v) and its depth w at the sample's own time t, and with
/// m = SampleSet::motion, at time t'
///
///     (p' w', w') = (p w, w) + (t' - t) m,    seen from (u', v') at p' + (C1/w' + C2) (u', v').
///
/// So m is in pixels times the unit of w, and in the unit of w, over the whole shutter. Where w is infinite,
/// m is that of a point at depth 1 in the same direction (a turning camera moves the sky, too).
struct LightFieldSample {
    float x, y, u, v;
    float t, w, slope, alpha;
};
static_assert(sizeof(LightFieldSample) == 32);

/// A sample's motion over its depth: (p', w') = ((p + (t' - t) q.xy) / r, r w) with r = 1 + (t' - t) q.z, and
/// the same p' where w is infinite.
inline glm::vec3 relativeMotion(const LightFieldSample& sample, glm::vec3 m) {
    return std::isinf(sample.w) ? m : m / sample.w;
}

/// Which optional planes of values there are.
struct SamplePlanes {
    bool albedo = false;  ///< and normals
    bool shading = false; ///< normals, illumination, reflectance and reflection
    bool shadows = false; ///< besides shading: position, light, blocker and direct
    bool motion = false;
};

/// Samples, and planes of values beside them: one value per sample, or none at all.
///
/// The radiance of a sample is reflectance * illumination, by the diffuse part of the surface that was seen,
/// plus its reflection, the rest of what the surface reflects, plus what it emits or the background sends.
struct SampleSet {
    std::vector<LightFieldSample> samples;
    std::vector<glm::vec3> radiance; ///< linear; one per sample
    std::vector<glm::vec3> albedo;   ///< in [0, 1]; may be empty
    std::vector<glm::vec3> normal; ///< world space, unit length, towards the camera; 0 where nothing was hit
    std::vector<glm::vec3> motion; ///< homogeneous, see below; empty where nothing moves
    std::vector<glm::vec3> illumination; ///< of the diffuse part; empty together with the next two
    std::vector<glm::vec3> reflectance;  ///< of the diffuse part
    std::vector<glm::vec3> reflection;
    // The ray from what was seen to a light, in world space; all at `position` where there was none.
    std::vector<glm::vec3> position; ///< of what was seen; empty together with the next three
    std::vector<glm::vec3> light;    ///< the place on the light; far away for a light without one
    std::vector<glm::vec3> blocker;  ///< where something is in the way, nearest to `position`; else = light
    std::vector<glm::vec3> direct;   ///< what the light adds to the illumination with nothing in the way

    SamplePlanes planes() const {
        return {!albedo.empty(), !illumination.empty(), !position.empty(), !motion.empty()};
    }
    bool hasGuides() const { return !albedo.empty(); }
    bool hasShading() const { return !illumination.empty(); }
    bool hasShadows() const { return hasShading() && !position.empty(); }
    bool moves() const { return !motion.empty(); }
    void resize(std::size_t count, SamplePlanes planes);
};

/// The planes of values, radiance first.
inline constexpr std::array<std::vector<glm::vec3> SampleSet::*, 11> kValuePlanes = {
    &SampleSet::radiance,     &SampleSet::albedo,      &SampleSet::normal,     &SampleSet::motion,
    &SampleSet::illumination, &SampleSet::reflectance, &SampleSet::reflection, &SampleSet::position,
    &SampleSet::light,        &SampleSet::blocker,     &SampleSet::direct};

inline constexpr std::array<const char*, kValuePlanes.size()> kValuePlaneNames = {
    "radiance",   "albedo",   "normal", "motion",  "illumination", "reflectance",
    "reflection", "position", "light",  "blocker", "direct"};

/// Room for samples and their values, of equal length; all but samples and radiance may be empty.
struct SampleSpans {
    std::span<LightFieldSample> samples;
    std::span<glm::vec3> radiance, albedo = {}, normal = {}, motion = {}, illumination = {}, reflectance = {},
                                   reflection = {}, position = {}, light = {}, blocker = {}, direct = {};
};
SampleSpans spansOf(SampleSet& set);

/// Samples in the order row, column, sample of a pixel: pixel k of `bounds`, counted row by row, holds
/// samples [firstSample(k), firstSample(k + 1)), each of them inside that pixel.
struct LightField : SampleSet {
    Rect bounds;             ///< pixels with samples: the frame and its overscan
    Rect frame;              ///< pixels of the picture to reconstruct
    int samplesPerPixel = 0; ///< of every pixel; 0 if pixels differ
    SlopeModel slopeModel;
    Aperture aperture; ///< over which lens positions are spread
    LensMap lensMap;   ///< empty: a thin lens; else pixels have equally many samples, halves aside
    std::vector<std::uint32_t> pixelStart; ///< if pixels differ: firstSample of each, and of one more

    std::size_t firstSample(std::size_t pixel) const {
        return pixelStart.empty() ? pixel * std::size_t(samplesPerPixel) : pixelStart[pixel];
    }
    std::size_t samplesOf(std::size_t pixel) const { return firstSample(pixel + 1) - firstSample(pixel); }
};

/// Makes a field whose motions are all 0 one where nothing moves.
void dropZeroMotion(LightField& field);

/// Samples per pixel: least, most, mean.
struct SampleCounts {
    std::size_t min = 0, max = 0;
    double mean = 0;
};
SampleCounts sampleCounts(const LightField& field);

/// Sets the number of samples of every pixel of `bounds`, row by row; the samples themselves are filled in
/// later.
void setSampleCounts(LightField& field, std::span<const std::uint32_t> counts);

/// Whether any sample's slope differs from the slope of its depth.
bool hasOwnSlopes(const LightField& field);

/// Whether slopes are C1/w + C2 throughout, and no lens map stands between them and the samples.
bool isThinLens(const LightField& field);

/// What `sanitize` found; each count is of samples. Components of illumination, reflectance and reflection
/// that are not finite or below zero are set to 0 without being counted: they are parts of the radiance.
struct FieldDefects {
    std::uint64_t nonFiniteRadiance = 0; ///< or 1e15 and more: set to 0
    std::uint64_t negativeRadiance = 0;  ///< components below zero set to 0
    std::uint64_t badDepth = 0;    ///< w <= 0 or NaN: the sample is disabled (slope = NaN, never binned)
    std::uint64_t outsideLens = 0; ///< u, v outside the unit disc or NaN: disabled
    std::uint64_t badPosition = 0; ///< x, y or t not finite, or slope not within 1e9: disabled
    std::uint64_t badMotion = 0;   ///< motion not finite, by itself or over w: disabled
    /// Of the rest: within the shutter w' falls below w / 16, or passes zero. The depth's motion is limited
    /// to w' >= w / 16, and the velocity on screen at the sample's own time, (m.xy - m.w p) / w, is kept.
    std::uint64_t limitedMotion = 0;
    std::uint64_t total() const;
    void add(const FieldDefects& other);
};

/// Applies the rules of FieldDefects to a sample of the field, its radiance and its motion (0 in a field
/// where nothing moves), and counts. A sample that is disabled has motion 0.
void repair(const LightField& field, LightFieldSample& sample, glm::vec3& radiance, glm::vec3& motion,
            FieldDefects& defects);

/// Applies the rules of FieldDefects to every sample, in place, and drops motions that are all 0;
/// reconstruction expects a sanitized field. Throws Error(usage) where planes of values are not as long as
/// the samples.
FieldDefects sanitize(LightField& field);

} // namespace slant

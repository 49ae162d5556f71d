// The light field: the contract between whoever traces samples and whoever reconstructs an image from them.
#pragma once
#include "base/rect.h"
#include "camera/aperture.h"
#include "camera/lens_map.h"
#include "camera/slope_model.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace slant {

/// One sample of the light field: what a ray through raster position (x, y), lens position (u, v) at shutter
/// time t saw. Twelve floats, three texels: uploaded as it is.
///
/// - x, y: raster position in pixels, y downwards; pixel (i, j) covers [i, i+1) x [j, j+1).
/// - u, v: lens position in the unit disc, in raster orientation: u to the right, v downwards, so that a
///   fixed point of slope s is seen at x + (u' - u) s, y + (v' - v) s from lens position (u', v').
/// - t: shutter time in [0, 1).
/// - w: camera-space depth > 0 along the viewing axis; +infinity where nothing was hit.
/// - slope: pixels per lens radius, for a thin lens C1/w + C2 with C1 < 0: the nearer, the smaller.
/// - r, g, b: linear radiance.
///
/// Through a lens of many surfaces x, y and u, v are on the film's side (camera/lens_map.h), and points move
/// so on the scene's.
/// - alpha: 1 where something was hit, else 0.
struct LightFieldSample {
    float x, y, u, v;
    float t, w, slope, alpha;
    float r, g, b;
    float areaExcess; ///< 0, but for samples on the scene's side of a lens (see onSceneSide)
};
static_assert(sizeof(LightFieldSample) == 48);

/// Guides for denoisers and compositors, one a sample.
struct AuxiliarySample {
    glm::vec3 albedo; ///< in [0, 1]
    glm::vec3 normal; ///< world space, unit length, towards the camera; 0 where nothing was hit
};

/// Samples in the order row, column, sample of a pixel: pixel k of `bounds`, counted row by row, holds
/// samples [firstSample(k), firstSample(k + 1)), each of them inside that pixel.
struct LightField {
    Rect bounds;             ///< pixels with samples: the frame and its overscan
    Rect frame;              ///< pixels of the picture to reconstruct
    int samplesPerPixel = 0; ///< of every pixel; 0 where they differ in it
    SlopeModel slopeModel;
    std::vector<LightFieldSample> samples;
    std::vector<AuxiliarySample> auxiliary;     ///< empty, or one a sample
    Aperture aperture;                          ///< over which lens positions are spread
    LensMap lensMap = {};                       ///< empty: a thin lens; else all pixels have as many samples
    std::vector<std::uint32_t> pixelStart = {}; ///< where pixels differ: firstSample of each, and of one more

    std::size_t firstSample(std::size_t pixel) const {
        return pixelStart.empty() ? pixel * std::size_t(samplesPerPixel) : pixelStart[pixel];
    }
    std::size_t samplesOf(std::size_t pixel) const { return firstSample(pixel + 1) - firstSample(pixel); }
};

/// How many samples the pixels have.
struct SampleCounts {
    std::size_t least = 0, most = 0;
    double mean = 0;
};
SampleCounts sampleCounts(const LightField& field);

/// Gives every pixel of `bounds`, row by row, as many samples; the samples themselves are still to come.
void setSampleCounts(LightField& field, std::span<const std::uint32_t> counts);

/// Whether any sample's slope is not that of its depth.
bool hasOwnSlopes(const LightField& field);

/// Whether slopes are C1/w + C2 throughout, and no lens map stands between them and the samples.
bool isThinLens(const LightField& field);

/// The samples of a field with a lens map as they are on the scene's side: xy and uv there, where slopes are
/// lines; radiances as the scene has them, without the irradiance that the lens makes of them; how much more
/// area samples there are spread over than on the film, less 1. Those where the film is dark are disabled.
/// The rest, the map also, stays.
LightField onSceneSide(const LightField& field);

/// What `sanitize` met; each count is of samples.
struct FieldDefects {
    std::uint64_t nonFiniteRadiance = 0; ///< set to 0
    std::uint64_t negativeRadiance = 0;  ///< components below zero set to 0
    std::uint64_t badDepth = 0;    ///< w <= 0 or NaN: the sample is disabled (slope = NaN, never binned)
    std::uint64_t outsideLens = 0; ///< u, v outside the unit disc or NaN: disabled
    std::uint64_t badPosition = 0; ///< x, y, t or slope not finite: disabled
    std::uint64_t total() const;
    void add(const FieldDefects& other);
};

/// Applies the rules of FieldDefects to one sample, and counts.
void repair(LightFieldSample& sample, FieldDefects& defects);

/// Applies the rules of FieldDefects to every sample, in place; reconstruction expects a sanitized field.
FieldDefects sanitize(LightField& field);

} // namespace slant

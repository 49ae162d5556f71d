// Which channel of a deep file holds which member of a sample.
#pragma once
#include "lightfield/lightfield.h"

#include <array>
#include <cstddef>

namespace slant {

struct DeepChannel {
    const char* name;
    std::size_t offset; ///< of the float in its struct
    bool required = true;
    bool exact = false; ///< half floats would not do
};

/// Of LightFieldSample.
inline constexpr std::array<DeepChannel, 8> kSampleChannels = {
    {{"A", offsetof(LightFieldSample, alpha), false},
     {"Z", offsetof(LightFieldSample, w), true, true},
     {"raster.x", offsetof(LightFieldSample, x), true, true},
     {"raster.y", offsetof(LightFieldSample, y), true, true},
     {"lens.u", offsetof(LightFieldSample, u)},
     {"lens.v", offsetof(LightFieldSample, v)},
     {"time", offsetof(LightFieldSample, t), false},
     {"slope", offsetof(LightFieldSample, slope), false, true}}};

/// A plane of values: three channels, float after float.
struct DeepPlane {
    std::array<DeepChannel, 3> channels;
    std::vector<glm::vec3> SampleSet::*values;
    bool SamplePlanes::*group; ///< present as one, or absent as one; null for radiance and normals
};

constexpr DeepPlane deepPlane(const char* x, const char* y, const char* z,
                              std::vector<glm::vec3> SampleSet::*values, bool SamplePlanes::*group = nullptr,
                              bool exact = false) {
    return {{{{x, 0, true, exact}, {y, sizeof(float), true, exact}, {z, 2 * sizeof(float), true, exact}}},
            values,
            group};
}

/// There together with albedo, with shading, or with both.
inline constexpr DeepPlane kNormalPlane = deepPlane("N.X", "N.Y", "N.Z", &SampleSet::normal);

inline constexpr std::array<DeepPlane, 11> kDeepPlanes = {
    deepPlane("R", "G", "B", &SampleSet::radiance),
    deepPlane("albedo.R", "albedo.G", "albedo.B", &SampleSet::albedo, &SamplePlanes::albedo),
    kNormalPlane,
    deepPlane("illumination.R", "illumination.G", "illumination.B", &SampleSet::illumination,
              &SamplePlanes::shading),
    deepPlane("reflectance.R", "reflectance.G", "reflectance.B", &SampleSet::reflectance,
              &SamplePlanes::shading),
    deepPlane("reflection.R", "reflection.G", "reflection.B", &SampleSet::reflection, &SamplePlanes::shading),
    deepPlane("P.X", "P.Y", "P.Z", &SampleSet::position, &SamplePlanes::shadows, true),
    deepPlane("light.X", "light.Y", "light.Z", &SampleSet::light, &SamplePlanes::shadows, true),
    deepPlane("blocker.X", "blocker.Y", "blocker.Z", &SampleSet::blocker, &SamplePlanes::shadows, true),
    deepPlane("direct.R", "direct.G", "direct.B", &SampleSet::direct, &SamplePlanes::shadows),
    deepPlane("motion.x", "motion.y", "motion.w", &SampleSet::motion, &SamplePlanes::motion, true)};

} // namespace slant

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
};

constexpr DeepPlane deepPlane(const char* x, const char* y, const char* z,
                              std::vector<glm::vec3> SampleSet::*values, bool exact = false) {
    return {{{{x, 0, true, exact}, {y, sizeof(float), true, exact}, {z, 2 * sizeof(float), true, exact}}},
            values};
}

inline constexpr DeepPlane kRadiancePlane = deepPlane("R", "G", "B", &SampleSet::radiance);
/// All of them, or none.
inline constexpr std::array<DeepPlane, 2> kGuidePlanes = {
    deepPlane("albedo.R", "albedo.G", "albedo.B", &SampleSet::albedo),
    deepPlane("N.X", "N.Y", "N.Z", &SampleSet::normal)};

inline constexpr DeepPlane kMotionPlane =
    deepPlane("motion.x", "motion.y", "motion.w", &SampleSet::motion, true);

} // namespace slant

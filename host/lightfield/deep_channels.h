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
inline constexpr std::array<DeepChannel, 11> kSampleChannels = {
    {{"R", offsetof(LightFieldSample, r)},
     {"G", offsetof(LightFieldSample, g)},
     {"B", offsetof(LightFieldSample, b)},
     {"A", offsetof(LightFieldSample, alpha), false},
     {"Z", offsetof(LightFieldSample, w), true, true},
     {"raster.x", offsetof(LightFieldSample, x), true, true},
     {"raster.y", offsetof(LightFieldSample, y), true, true},
     {"lens.u", offsetof(LightFieldSample, u)},
     {"lens.v", offsetof(LightFieldSample, v)},
     {"time", offsetof(LightFieldSample, t), false},
     {"slope", offsetof(LightFieldSample, slope), false, true}}};

/// Of AuxiliarySample: all of them, or none.
inline constexpr std::array<DeepChannel, 6> kAuxiliaryChannels = {
    {{"albedo.R", offsetof(AuxiliarySample, albedo)},
     {"albedo.G", offsetof(AuxiliarySample, albedo) + 4},
     {"albedo.B", offsetof(AuxiliarySample, albedo) + 8},
     {"N.X", offsetof(AuxiliarySample, normal)},
     {"N.Y", offsetof(AuxiliarySample, normal) + 4},
     {"N.Z", offsetof(AuxiliarySample, normal) + 8}}};

/// Read to tell moving samples from others; not kept.
struct MotionSample {
    float x, y, w;
};
inline constexpr std::array<DeepChannel, 3> kMotionChannels = {{{"motion.x", offsetof(MotionSample, x)},
                                                                {"motion.y", offsetof(MotionSample, y)},
                                                                {"motion.w", offsetof(MotionSample, w)}}};

} // namespace slant

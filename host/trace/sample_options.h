// How a light field is to be sampled.
#pragma once
#include "lightfield/lightfield.h"

namespace slant {

/// What the slopes of samples are those of.
enum class SlopeSource {
    optics, ///< of the image, where mirrors and glass show one (trace/specular_chain.h)
    surface ///< of the first surface
};

struct SampleOptions {
    int samplesPerPixel = 8;
    std::uint64_t seed = 0;
    SlopeSource slopes = SlopeSource::optics;
    SamplePlanes planes = {};               ///< to record; motion is recorded where anything moves
    std::uint64_t memoryBytes = 8ull << 30; ///< budget of the light field
};

} // namespace slant

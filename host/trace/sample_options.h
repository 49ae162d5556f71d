// How a light field is to be sampled.
#pragma once
#include "lightfield/lightfield.h"

namespace slant {

struct SampleOptions {
    int samplesPerPixel = 8;
    std::uint64_t seed = 0;
    SamplePlanes planes = {};               ///< to record; motion is recorded where anything moves
    std::uint64_t memoryBytes = 8ull << 30; ///< budget of the light field
};

} // namespace slant

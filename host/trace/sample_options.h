// How a light field is to be sampled.
#pragma once
#include <cstdint>

namespace slant {

struct SampleOptions {
    int samplesPerPixel = 8;
    std::uint64_t seed = 0;
    bool guides = false;                    ///< record albedo and normal too
    std::uint64_t memoryBytes = 4ull << 30; ///< budget of the light field
};

} // namespace slant

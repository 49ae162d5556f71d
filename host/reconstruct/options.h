// How a light field is to be reconstructed.
#pragma once
#include "reconstruct/method.h"
#include "scene/scene.h"

#include <cstdint>
#include <optional>

namespace slant {

/// Parameters of the method `window`; the defaults are those of the program it is taken from.
struct WindowOptions {
    int rangePx = 4;                    ///< samples of pixels up to this far to each side are searched
    float alpha = 100;                  ///< of the Gaussian exp(-alpha distance^2), per square pixel
    std::optional<float> lensStep = {}; ///< lens radii; unset: 1 / sqrt(samples per pixel)
    bool fill = false; ///< where no sample is near, take the nearest of the window; else the output is black
};

struct ReconstructOptions {
    Method method = Method::automatic;
    int outputsPerPixel = 128; ///< a power of two; `box` has none
    PixelFilter filter;
    WindowOptions window;
    bool anyFocus = false; ///< pictures of other focuses are wanted (LensView); not `box`, not `window`
    std::uint64_t seed = 0;
    std::uint64_t memoryBytes = std::uint64_t(1) << 30; ///< for dense samples and lists
};

/// Dense samples (vec4) that may be held at a time: half the memory budget; a layer map may take the other
/// half.
inline std::uint64_t maxDenseSamples(const ReconstructOptions& options) {
    return options.memoryBytes / 2 / (4 * sizeof(float));
}

} // namespace slant

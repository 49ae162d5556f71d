// How a light field is to be sampled.
#pragma once
#include "lightfield/lightfield.h"

namespace slant {

/// What the slopes of samples are those of.
enum class SlopeSource {
    optics, ///< of the image, where mirrors and glass show one (trace/specular_chain.h)
    surface ///< of the first surface
};

/// Which samples of each pixel of a rectangle are traced: samples [first, first + count) of all, or, if
/// `starts` is not empty, as many as there are from starts[k] up to before starts[k + 1] of pixel k, counted
/// row by row.
struct PixelSamples {
    int first = 0, count = 0;
    std::span<const std::uint32_t> starts = {};

    int countOf(std::size_t pixel) const {
        return starts.empty() ? count : int(starts[pixel + 1] - starts[pixel]);
    }
    /// Where those of a pixel stand among all.
    std::size_t startOf(std::size_t pixel) const {
        return starts.empty() ? pixel * std::size_t(count) : starts[pixel];
    }
};

struct SampleOptions {
    int samplesPerPixel = 8;
    std::uint64_t seed = 0;
    SlopeSource slopes = SlopeSource::optics;
    SamplePlanes planes = {};               ///< to record; motion is recorded where anything moves
    std::uint64_t memoryBytes = 8ull << 30; ///< budget of the light field
};

} // namespace slant

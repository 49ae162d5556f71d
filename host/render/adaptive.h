// Samples where they are needed: after a first pass, the estimated error of the picture says where more go.
#pragma once
#include "render/error_estimate.h"
#include "render/render.h"

namespace slant {

/// Of the first pass: all samples per pixel but the share that is to be placed, rounded, and at least one.
int firstPassSamples(int samplesPerPixel, double placedShare);

/// Adds samples to a traced field, pass by pass.
class SamplePlacement {
public:
    /// All must outlive it, and `traced` may be empty still. Throws Error(usage) for a compound lens: its
    /// fields have equally many samples in every pixel.
    SamplePlacement(const Tracer& tracer, const SampleOptions& options, TracedField& traced,
                    Monitor& monitor);

    /// Traces about so many samples of the frame, where `estimate` of the field as it is says; fewer where no
    /// pixel needs more, or where the memory budget of the samples ends. Returns how many.
    std::uint64_t add(const ErrorEstimate& estimate, std::uint64_t samples);
    /// Samples of the frame so far.
    std::uint64_t samples() const;

private:
    std::vector<std::uint32_t> counts() const;

    const Tracer& tracer_;
    const SampleOptions& options_;
    TracedField& traced_;
    Monitor& monitor_;
    int pass_ = 0;
};

} // namespace slant

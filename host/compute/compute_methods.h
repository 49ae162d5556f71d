// The methods on the device, a row of peers: each fills the film of a run, stage by stage as its namesake of
// reconstruct/cpu_methods.h does.
#pragma once
#include "compute/film_pass.h"
#include "compute/focused_bins.h"
#include "reconstruct/focused_bins.h"

#include <algorithm>

namespace slant {

/// Bins of a field; unset until a method asks for them.
struct ComputeBins {
    std::optional<DeviceFocusedBins> onDevice;
    std::optional<FocusedBins> onCpu; ///< for what a shader cannot loop over
};

/// One picture on the device: what every method is given.
struct ComputeRun {
    Device& device;
    const LightField& field;
    const ReconstructOptions& options;
    ComputeBins& prepared;
    float slopeShift; ///< see PreparedField
    Monitor& monitor;
    ReconstructReport& report;
    IntermediateObserver* observer; ///< may be null
    FilmBuffer film{field.frame, makeFilterTable(options.filter)};
    FilmPass filmPass{device, film};
    CommandList commands{device}; ///< empty between stages
    /// Dense samples that may be held at a time.
    std::uint64_t maxSamples = std::min(maxDenseSamples(options), device.limits().texelBufferElements);

    /// Words of a buffer's first texels for the observer.
    void observe(const char* name, const Buffer& buffer, std::uint64_t texels) const;
    void observe(const char* name, const Buffer& buffer) const { observe(name, buffer, buffer.texels()); }
    /// Stages "bin", unless it is done, and "refocus", timed; observed.
    const DeviceBins& bins();
    const Bins& binsOnCpu();

private:
    BinScope binScope() const;
};

using ComputeMethod = void(ComputeRun& run);
ComputeMethod boxMethod, windowMethod, fullMethod;

} // namespace slant

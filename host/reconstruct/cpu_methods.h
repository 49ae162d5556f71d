// The methods on the CPU, a row of peers: each fills the film of a run, and nothing else.
#pragma once
#include "reconstruct/film_buffer.h"
#include "reconstruct/focused_bins.h"
#include "reconstruct/method.h"

#include <optional>
#include <span>
#include <vector>

namespace slant {

/// One picture on the CPU: what every method is given.
struct CpuRun {
    const LightField& field;
    const ReconstructOptions& options;
    std::optional<FocusedBins>& prepared; ///< unset until a method asks for bins
    float slopeShift;                     ///< see PreparedField
    Monitor& monitor;
    ReconstructReport& report;
    IntermediateObserver* observer; ///< may be null
    FilmBuffer film;

    template <typename T>
    void observe(const char* name, const std::vector<T>& values) const {
        if (observer)
            observer->stage(name, {reinterpret_cast<const uint*>(values.data()),
                                   values.size() * sizeof(T) / sizeof(uint)});
    }
    /// Stages "bin", unless it is done, and "refocus", timed; observed.
    const Bins& bins() const;
};

using CpuMethod = void(CpuRun& run);
CpuMethod boxMethod, windowMethod, fullMethod;

} // namespace slant

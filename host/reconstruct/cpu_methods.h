// The methods on the CPU, a row of peers: each fills the film of a run, and nothing else.
#pragma once
#include "reconstruct/bins.h"
#include "reconstruct/film_buffer.h"
#include "reconstruct/method.h"

#include <span>
#include <vector>

namespace slant {

/// One reconstruction on the CPU: what every method is given.
struct CpuRun {
    const LightField& field;
    const ReconstructOptions& options;
    Monitor& monitor;
    ReconstructReport& report;
    StageObserver* observer; ///< may be null
    FilmBuffer film;

    template <typename T>
    void observe(const char* name, const std::vector<T>& values) const {
        if (observer)
            observer->stage(name, {reinterpret_cast<const uint*>(values.data()),
                                   values.size() * sizeof(T) / sizeof(uint)});
    }
    /// Stage "bin", timed and observed.
    Bins bin() const;
};

using CpuMethod = void(CpuRun& run);
CpuMethod boxMethod, windowMethod, fullMethod;

} // namespace slant

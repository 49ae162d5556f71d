// The method `window` on the CPU for one chunk: some lens groups over one band of rows.
#pragma once
#include "base/monitor.h"
#include "reconstruct/film_buffer.h"
#include "reconstruct/plan.h"
#include "reconstruct/window.h"

#include <array>
#include <span>

namespace slant {

class WindowChunk {
public:
    /// Outputs look through `lens` unless it is empty.
    WindowChunk(const WindowSamples& samples, const WindowSearch& search, const LensMap& lens,
                const OutputPattern& pattern, const Band& band, std::uint64_t seed, std::size_t firstGroup,
                std::size_t groupCount);

    /// Every output; progress in outputs. Adds to the counts of `report`.
    void run(Monitor& monitor, ReconstructReport& report);

    /// Only these samples of `dense`, by index: those that the compute path leaves to the CPU. Adds to the
    /// counts of `report` but for the outputs.
    void redo(std::span<const uint> indices, ReconstructReport& report);

    DenseSamples dense;

private:
    using Counts = std::array<std::uint64_t, 4>; ///< of each WindowOutcome

    template <typename IndexAt>
    Counts look(std::size_t count, const IndexAt& indexAt, Monitor* monitor);

    const WindowSamples& samples_;
    WindowSearch search_;
    const LensMap& lens_;
    const OutputPattern& pattern_;
    OutputLayout layout_;
    int firstOutput_;
};

/// Tells of the outputs that found nothing, once for a whole picture.
void warnOfHoles(const ReconstructReport& report, Monitor& monitor);

} // namespace slant

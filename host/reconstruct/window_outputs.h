// The outputs of one chunk of the method `window` on the CPU.
#pragma once
#include "base/monitor.h"
#include "reconstruct/film_buffer.h"
#include "reconstruct/plan.h"
#include "reconstruct/report.h"
#include "reconstruct/window.h"

#include <span>

namespace slant {

class WindowOutputs {
public:
    /// Outputs look through `lens` unless it is empty. What it refers to outlives it.
    WindowOutputs(const WindowSamples& samples, const WindowSearch& search, const LensMap& lens,
                  const OutputPattern& pattern, const Chunk& chunk);

    /// Every output; progress in outputs.
    SearchCounts look(Monitor& monitor);
    /// Only these samples of `dense`, by index: those that the compute path leaves to the CPU.
    SearchCounts redo(std::span<const uint> indices);

    DenseSamples dense;

private:
    template <typename IndexAt>
    SearchCounts lookAt(std::size_t count, const IndexAt& indexAt, Monitor& monitor);

    const WindowSamples& samples_;
    const WindowSearch& search_;
    const LensMap& lens_;
    const OutputPattern& pattern_;
    Chunk chunk_;
};

} // namespace slant

// Method `window` on the device: every output from a fixed window of pixels. The same words as WindowOutputs
// (reconstruct/window_outputs.h).
#pragma once
#include "compute/command_list.h"
#include "reconstruct/plan.h"
#include "reconstruct/report.h"
#include "reconstruct/window.h"

namespace slant {

class WindowPass {
public:
    /// Outputs of `pattern` look through `lens` unless it is empty. `samples` are uploaded.
    WindowPass(Device& device, const WindowSamples& samples, const WindowSearch& search, const LensMap& lens,
               const OutputPattern& pattern);

    /// Counts of one chunk; an output that overflowed is in no other count.
    struct Result {
        SearchCounts counts;
        std::vector<uint> overflowed; ///< indices into dense that are still to be done, ascending
    };
    /// Fills `dense`. `stepsPerOutput` counts the steps of a whole window: if they are too many for a shader,
    /// all outputs are left to the CPU. Runs on `commands`, which must be empty, and leaves it empty.
    Result run(CommandList& commands, const Chunk& chunk, std::uint64_t stepsPerOutput, const Buffer& dense);

    const Buffer& positions() const { return positions_; }
    const Buffer& values() const { return values_; }
    const Buffer& motions() const { return motions_; }

private:
    Device& device_;
    WindowSearch search_;
    ivec2 lensCells_;
    float lensScale_;
    Pass pass_;
    Buffer positions_, values_, motions_, motionTexels_, pixelStart_, entries_, aperture_, lensMap_,
        counters_, overflowList_;
};

} // namespace slant

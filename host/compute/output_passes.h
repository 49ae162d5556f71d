// Stages "reconstruct" and "visibility" on the device: the outputs of one chunk of lens groups over one band.
#pragma once
#include "compute/list_passes.h"
#include "reconstruct/list_work.h"
#include "reconstruct/report.h"

#include <vector>

namespace slant {

class OutputPasses {
public:
    /// Outputs look through `lens` unless it is empty.
    OutputPasses(Device& device, const OutputPattern& pattern, const LensMap& lens,
                 const SearchKernel& kernel);

    /// Counts of one chunk; an output that overflowed is in no other count.
    struct Result {
        SearchCounts counts;
        std::vector<uint> overflowed; ///< indices into dense that are still to be done, ascending
    };

    /// Fills `dense` (planes of region pixels) for the lists of `work`: in each list the pixels `missed`, 64
    /// bits per list; in sparse lists only 2^push.takenBits outputs of a group. `lists` have a margin of 2 R.
    /// Runs on `commands`, which must be empty, and leaves it empty.
    Result run(CommandList& commands, ListPasses& listPasses, const DeviceBins& bins,
               const DeviceLists& lists, const ListWork& work, const Buffer& missed, OutputPush push,
               const Buffer& dense);

    /// Entries of the output pattern.
    const Buffer& pattern() const { return pattern_; }

private:
    using Counters = std::vector<uint>;
    void reserve(std::uint64_t samples);
    Counters counters() const;

    Device& device_;
    Pass search_, visibility_;
    Buffer pattern_, aperture_, lensMap_;
    Buffer counters_;
    Buffer visibilityList_, holeList_, overflowList_;
};

} // namespace slant

// How the outputs of a picture stream through memory: bands of rows, and in each band chunks of lens groups.
// The picture does not depend on the plan.
#pragma once
#include "reconstruct/filter_table.h"
#include "reconstruct/method.h"
#include "reconstruct/output_pattern.h"

#include <cstdint>
#include <vector>

namespace slant {

/// Widest search: 2 * 2^3 R (three doublings).
constexpr int kWidenings = 3;
constexpr float kSearchRadii = 16;

struct Band {
    int y0, y1;  ///< rows of the frame that it finishes
    Rect region; ///< pixels whose outputs it needs: the rows and the filter's reach
    OutputLayout layout;
};

struct Plan {
    std::vector<Band> bands;
    int groupsPerChunk = 1;
    Rect region;               ///< of all bands together
    std::uint64_t outputs = 0; ///< in all
};

/// Throws Error(resources) when even one row of tiles with one lens group exceeds `memoryBytes`.
Plan planOutputs(const Rect& frame, const FilterTable& filter, const OutputPattern& pattern,
                 std::uint32_t seed, std::uint64_t memoryBytes, std::uint64_t maxDenseSamples);

} // namespace slant

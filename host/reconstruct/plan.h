// How the outputs of a picture stream through memory: bands of rows, and in each band chunks of lens groups.
// The picture does not depend on the plan.
#pragma once
#include "reconstruct/filter_table.h"
#include "reconstruct/options.h"
#include "reconstruct/output_pattern.h"

#include <cstdint>
#include <limits>
#include <vector>

namespace slant {

struct Band {
    int y0, y1;  ///< rows of the frame that it finishes
    Rect region; ///< pixels whose dense samples it needs: the rows and the filter's reach
};

/// Bands of up to `maxRows` rows whose region holds at most `maxSamples` dense samples at `planes` per pixel.
/// Throws Error(resources) if one row of tiles needs more.
std::vector<Band> planBands(const Rect& frame, const FilterTable& filter, int planes,
                            std::uint64_t maxSamples, int maxRows = std::numeric_limits<int>::max());

/// The whole picture and the filter's reach around it.
Rect outputRegion(const Rect& frame, const FilterTable& filter);

/// Throws Error(resources), as the reconstruction of such a field would, if the memory budget is too small
/// for a row of tiles. This check needs no samples.
void checkBudget(const Rect& frame, int mostSamplesPerPixel, const ReconstructOptions& options);

struct Plan {
    std::vector<Band> bands;
    int groupsPerChunk = 1;    ///< whole film blocks
    std::uint64_t outputs = 0; ///< in all
};

/// Some lens groups over one band.
struct Chunk {
    Band band;
    OutputLayout layout;
    int firstGroup = 0, groupCount = 0;
    int firstOutput = 0;
    int planes = 0; ///< outputs per pixel

    std::uint64_t outputs() const { return band.region.area() * std::uint64_t(planes); }
};

/// Bands of up to `maxRows` rows and chunks of at most `maxSamples` dense samples.
Plan planOutputs(const Rect& frame, const FilterTable& filter, const OutputPattern& pattern,
                 std::uint64_t maxSamples, int maxRows = std::numeric_limits<int>::max());

/// The chunks of a band, in order.
std::vector<Chunk> chunksOf(const Plan& plan, const Band& band, const OutputPattern& pattern,
                            std::uint64_t seed);

} // namespace slant

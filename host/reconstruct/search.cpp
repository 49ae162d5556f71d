#include "reconstruct/search.h"

#include "reconstruct/kernels.h"

#include <limits>

namespace slant {
namespace {

template <bool kMoving>
struct NearestKernels {
#include "reconstruct/bin_fetches.h"

#include "lib/nearest.glsl"

#include "lib/search.glsl"
};

template <bool kMoving>
struct VisibilityKernels {
#include "reconstruct/bin_fetches.h"

#include "lib/visibility.glsl"

#include "lib/search.glsl"
};

/// What resources/search_outputs.glsl does with the kernels of a method.
template <typename Kernels>
Reconstructed searchWithin(const SearchContext& context, const Output& output) {
    const GridLayout& grid = context.bins.grid;
    Kernels kernels{context};
    auto sweep = kernels.newSweep(grid.radiusPx, grid.surfaceGap);
    Reconstructed result;
    result.iterations = kernels.forEachCandidate(grid, output, grid.radiusPx, kAnyRadiusRatio, 0,
                                                 kernels.listLength(), sweep);
    const bool taken = kernels.isTaken(sweep);
    result.outcome = taken ? Outcome::resolved : Outcome::needsVisibility;
    if (taken) result.rgb = kernels.valueOf(sweep);
    return result;
}

template <typename Kernels>
Reconstructed resolveWithin(const SearchContext& context, const Output& output, float baseRadius) {
    const GridLayout& grid = context.bins.grid;
    Kernels kernels{context};
    auto sweep = kernels.newSweep(grid, baseRadius);
    Reconstructed result;
    result.iterations = kernels.forEachCandidate(grid, output, 2 * baseRadius, kAnyRadiusRatio, 0,
                                                 kernels.listLength(), sweep);
    if (!kernels.foundNothing(sweep)) result.outcome = Outcome::resolved;
    result.rgb = kernels.radianceOf(sweep);
    return result;
}

} // namespace

Reconstructed reconstructNearest(const SearchContext& context, const Output& output) {
    return context.bins.motion.moves() ? searchWithin<NearestKernels<true>>(context, output)
                                       : searchWithin<NearestKernels<false>>(context, output);
}

Reconstructed resolveVisibility(const SearchContext& context, const Output& output, float baseRadius) {
    return context.bins.motion.moves() ? resolveWithin<VisibilityKernels<true>>(context, output, baseRadius)
                                       : resolveWithin<VisibilityKernels<false>>(context, output, baseRadius);
}

} // namespace slant

// One output against the bins: the inner loop of the reconstruction, as clear as it can be. The compute
// path's lib/search.glsl and lib/surfaces.glsl have the same names and the same order of operations.
#pragma once
#include "reconstruct/candidates.h"

namespace slant {

enum class Outcome {
    resolved,        ///< rgb is set
    needsVisibility, ///< more than one apparent surface, or nothing, within R
    hole,            ///< nothing within twice the base radius
};

struct Reconstructed {
    Outcome outcome = Outcome::hole;
    vec3 rgb{0};
    int iterations = 0; ///< loop steps taken; beyond kMaxLoopIterations compute leaves the output to the CPU
};

/// The front-most apparent surface within R, tent-filtered, where it is the only one or its samples surround
/// the output. Anything else needs resolveVisibility.
Reconstructed reconstructNearest(const SearchContext& context, const Output& output);

/// Splits the samples within twice `baseRadius` into apparent surfaces and lays them over one another, front
/// to back: one that surrounds the output hides the rest, another covers as much as its samples are many, and
/// the last is taken as it is. After Lehtinen et al. 2011, section 4, but that surfaces are split at gaps in
/// slope instead of at pairwise crossings (bricks come front to back, so one sweep finds them without storing
/// candidates, and there is no limit on their number), and that a surface which does not cover the output is
/// not dropped but weighed by its density, so that small and thin things keep their brightness.
Reconstructed resolveVisibility(const SearchContext& context, const Output& output, float baseRadius);

} // namespace slant

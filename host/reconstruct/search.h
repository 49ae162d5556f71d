// One output against the bins: the inner loop of the reconstruction.
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

/// From the front-most apparent surface within R (shaders/lib/nearest.glsl). An output that needs more goes
/// to resolveVisibility.
Reconstructed reconstructNearest(const SearchContext& context, const Output& output);

/// From all apparent surfaces within twice `baseRadius` (shaders/lib/visibility.glsl).
Reconstructed resolveVisibility(const SearchContext& context, const Output& output, float baseRadius);

} // namespace slant

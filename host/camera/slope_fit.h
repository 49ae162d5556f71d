// Slope models on the film's side: how much a sample has to know to predict where its point is seen through
// another part of the exit pupil. A lens that images sharply needs two constants. Real lenses need more, and
// even the best model leaves an error: that is why rays are described on the scene's side (lens_map.h).
#pragma once
#include "camera/compound_lens.h"

#include <vector>

namespace slant {

inline constexpr double kSlopeTolerancePx = 0.25;

enum class SlopeFitKind {
    lens,       ///< c1 / depth + c2, the same for all samples
    filmRadius, ///< c1 and c2 by distance from the middle of the film, along and across the radius
    sample,     ///< from the lens itself, by the derivatives of the sample's own ray
};

/// Slopes c1 / depth + c2: x along the film radius, y across it.
struct RadialSlope {
    glm::dvec2 c1{0}, c2{0};

    glm::dvec2 at(double inverseDepth) const { return c1 * inverseDepth + c2; }
};

/// Parameters of the lower fits.
struct SlopeFit {
    RadialSlope whole;                 ///< the same in both directions
    std::vector<RadialSlope> byRadius; ///< evenly spaced from 0 to radiusPx
    double radiusPx = 0;

    /// At `px` pixels from the middle of the film.
    RadialSlope at(SlopeFitKind fit, double px) const;
};

/// How the raster position changes with the place on the exit pupil through which a point of the ray is seen,
/// `inverseDepth` = 1 / depth, in pixels per radius.
glm::dmat2 slopeMatrix(const ScenePath& path, double inverseDepth);

/// Means over the pupil of the derivatives of trajectories, fitted to depths that are evenly spaced in their
/// inverse; the whole film counts by its light.
SlopeFit fitSlopes(const CompoundLens& camera, double nearDepth, double farDepth);

} // namespace slant

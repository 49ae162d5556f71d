// The ladder of slope models: how much a sample has to know to say where its point is seen through another
// part of the lens. A lens that images sharply needs two constants, a real one more or less.
#pragma once
#include "camera/slope_model.h"

#include <glm/glm.hpp>
#include <vector>

namespace slant {

class CompoundLens;

inline constexpr double kSlopeTolerancePx = 0.25;

enum class SlopeRung {
    lens,       ///< c1 / depth + c2, the same for all samples
    filmRadius, ///< c1 and c2 by distance from the middle of the film, along and across the radius
    sample,     ///< from the lens itself, by the derivatives of the sample's own ray
};

/// Slopes c1 / depth + c2: x along the film radius, y across it.
struct RadialSlope {
    glm::dvec2 c1{0}, c2{0};

    glm::dvec2 at(double inverseDepth) const { return c1 * inverseDepth + c2; }
    SlopeModel mean() const { return {float((c1.x + c1.y) / 2), float((c2.x + c2.y) / 2)}; }
};

/// Of the lower rungs.
struct SlopeFit {
    RadialSlope whole;                 ///< the same in both directions
    std::vector<RadialSlope> byRadius; ///< evenly spaced from 0 to radiusPx
    double radiusPx = 0;

    /// At `px` pixels from the middle of the film.
    RadialSlope at(SlopeRung rung, double px) const;
};

/// Means over the pupil of the derivatives of trajectories, fitted to depths that are evenly spaced in their
/// inverse; the whole film counts by its light.
SlopeFit fitSlopes(const CompoundLens& camera, double nearDepth, double farDepth);

} // namespace slant

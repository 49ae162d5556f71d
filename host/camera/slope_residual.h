// How far from the truth each slope model puts points of the scene on the raster. All but the last look at
// rays on the film's side, through the exit pupil.
#pragma once
#include "camera/slope_fit.h"

#include <vector>

namespace slant {

/// Pixels between where a point is seen through one lens position and where its sample at another one
/// predicts it, over pairs of lens positions all over the pupil.
struct Residual {
    double percentile95 = 0, maximum = 0;
};

/// At one depth, over the field up to the corners of the film.
struct DepthResiduals {
    double depth = 0;    ///< metres, may be infinite
    double blurPx = 0;   ///< largest slope met
    Residual lens;       ///< one slope for the whole lens
    Residual radiusMean; ///< by film radius, the mean of radial and tangential
    Residual radius;     ///< by film radius, the two apart
    /// The same, after subtracting from raster positions what the lens does to points in focus: how much
    /// trajectories curve in the same way at all depths.
    Residual corrected;
    Residual sampleMean; ///< by sample, the isotropic part
    Residual sample;     ///< by sample, 2 x 2
    Residual scene;      ///< on the scene's side, one slope for the whole lens: what the lens map leaves
};

/// At `nearDepth`, in focus (if between them) and at `farDepth`, which may be infinite.
std::vector<DepthResiduals> slopeResiduals(const CompoundLens& camera, double nearDepth, double farDepth);

/// The largest 95th percentile of a fit's isotropic slopes.
double worstResidual(const std::vector<DepthResiduals>& residuals, SlopeFitKind fit);

/// The lowest fit whose isotropic residuals have a 95th percentile within the tolerance at each depth; else
/// the fit with the smallest one.
SlopeFitKind selectSlopeFit(const std::vector<DepthResiduals>& residuals, double tolerancePx);

} // namespace slant

// Another focus for a light field that was traced once.
#pragma once
#include "lightfield/lightfield.h"

#include <optional>

namespace slant {

/// The distance in focus, in the unit of w; nothing unless it is finite.
std::optional<double> focusDistance(const SlopeModel& model);

/// The field of a thin lens focused at `distance` (infinite is allowed) instead. Every sample is seen through
/// the same point of the lens as before: C2 changes by some d, each slope by d, and each position by d (u,
/// v), so that the pinhole position stays. Samples may leave the pixels that hold them: only a method that
/// finds samples where they lie will do. Throws Error(usage) unless isThinLens(field), for a pinhole, and for
/// a distance that is not positive.
LightField refocused(LightField field, double distance);

/// How many pixels beyond the samples of `bounds` blur reaches into the frame, for a lens `lensScale` times
/// as wide as the traced one: that deep, borders lack what enters from there. 0 if nothing is missing.
int missingOverscanPx(const LightField& field, float lensScale);

} // namespace slant

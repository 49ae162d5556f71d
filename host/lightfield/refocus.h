// Another focus for a light field that was traced once.
#pragma once
#include "lightfield/lens_view.h"

#include <optional>

namespace slant {

/// The distance in focus, in the unit of w; nothing unless it is finite.
std::optional<double> focusDistance(const SlopeModel& model);

/// The constants of the field's lens focused at `distance` (infinite is allowed) instead. Every sample is
/// seen through the same point of the lens as before: C2 changes by some d, each slope by d, and each
/// position by d (u, v), so that the pinhole position stays. Throws Error(usage) unless isThinLens(field),
/// for a pinhole, and for a distance that is not positive or makes blur infinite.
SlopeModel focusedAt(const LightField& field, double distance);

/// How many pixels beyond the samples of `bounds` blur and motion can reach into the frame, seen through
/// another lens. Borders of that width lack what enters from there. 0 if nothing is missing.
int missingOverscanPx(const LightField& field, const LensView& view);

} // namespace slant

// A lens in section, as a picture.
#pragma once
#include "camera/compound_lens.h"

#include <string>

namespace slant {

/// An SVG of glass, stop, film and of rays that reach the middle of the film and, in another colour, its edge
/// at half the width: followed through the surfaces, spread over the pupil.
std::string drawLens(const CompoundLens& camera, double filmWidthMm);

} // namespace slant

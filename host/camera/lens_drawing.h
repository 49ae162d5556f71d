// A picture of a lens in section.
#pragma once
#include "camera/compound_lens.h"

#include <string>

namespace slant {

/// An SVG of glass, stop, film, and rays that reach the middle of the film and, in another colour, its edge
/// at half the width. The rays are traced through the surfaces and spread over the pupil.
std::string drawLens(const CompoundLens& camera, double filmWidthMm);

} // namespace slant

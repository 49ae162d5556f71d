// Lens prescriptions in pbrt's table format: four numbers per surface, from front to rear; '#' begins a
// comment.
#pragma once
#include "scene/scene.h"

#include <string>

namespace slant {

/// A prescription that can be built: one stop, indices of at least 1 (0 means air, as in published tables),
/// clear diameters that fit the curvature, and no surface that touches the next one. Throws Error(badInput)
/// at the line at fault.
LensPrescription parseLens(const std::string& text, const std::string& name);

/// The same for a file. `where` is the place that names the file, if there is one.
LensPrescription readLens(const std::string& path, const FileLocation& where);

} // namespace slant

// Lens prescriptions in pbrt's table format: four numbers a surface, from front to rear; '#' begins a
// comment.
#pragma once
#include "scene/scene.h"

#include <string>

namespace slant {

/// A prescription whose surfaces can stand where they stand: one stop, indices of at least 1 (0 is taken for
/// air, as published tables have it), clear diameters that fit the curvature, and no surface that meets the
/// next one. Throws Error(badInput) at the line at fault.
LensPrescription parseLens(const std::string& text, const std::string& name);

/// The same of a file. `where` names the file, if something does.
LensPrescription readLens(const std::string& path, const FileLocation& where);

} // namespace slant

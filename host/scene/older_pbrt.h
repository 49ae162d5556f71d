// Text of pbrt-v2 and -v3, as pbrt-v4's own upgrade translates it.
#pragma once
#include "scene/parameters.h"

#include <string>
#include <string_view>

namespace slant {

/// Translates the kind and the parameters of an entity where they are of an older pbrt, with a note for what
/// is lost. What is of pbrt-v4 already stays as it is. `directive` is Film, Material, ...; true if anything
/// was old. Throws Unsupported for what has no translation.
bool upgradeEntity(std::string_view directive, const Position& where, std::string& kind,
                   ParameterVector& parameters, Issues& issues);

} // namespace slant

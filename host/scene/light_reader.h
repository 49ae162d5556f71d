// LightSource and AreaLightSource directives as plain lights.
#pragma once
#include "scene/parameters.h"
#include "scene/scene.h"

#include <string>

namespace slant {

class SceneFiles;

/// Throws Error(badInput), also for parameters that the kind does not have.
Light readLight(const std::string& kind, ParameterList& parameters, const glm::dmat4& worldFromLight,
                SceneFiles& files);

/// Throws Error(badInput) as above.
AreaLight readAreaLight(const std::string& kind, ParameterList& parameters, SceneFiles& files);

} // namespace slant

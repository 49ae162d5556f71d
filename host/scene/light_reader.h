// LightSource and AreaLightSource directives as plain lights.
#pragma once
#include "scene/parameters.h"
#include "scene/scene.h"

#include <string>

namespace slant {

class SceneFiles;

/// `scale` of the result has pbrt's "power" and "illuminance" applied already. Throws Error(badInput), also
/// for parameters that the kind does not have.
Light readLight(const std::string& kind, ParameterList& parameters, const glm::dmat4& worldFromLight,
                const Scene& scene, SceneFiles& files);

/// Throws Error(badInput) as above. Its power needs the shape's area and is left to the renderer.
AreaLight readAreaLight(const std::string& kind, ParameterList& parameters);

} // namespace slant

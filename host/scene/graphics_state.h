// What AttributeBegin saves and AttributeEnd restores.
#pragma once
#include "scene/parameters.h"
#include "scene/transforms.h"

#include <array>

namespace slant {

struct GraphicsState {
    MovingTransform transform; ///< pbrt's CTM: world (before WorldBegin: camera) from object space
    ActiveTransform active = ActiveTransform::all;
    bool reverseOrientation = false;
    const ColourSpace* colourSpace = nullptr; ///< of rgb parameters; Rec.709 if null
    int materialIndex = 0;
    int areaLightIndex = -1;
    /// Defaults that Attribute sets, by target.
    std::array<ParameterVector, 4> defaults;
};

enum class AttributeTarget { shape, light, material, texture };

} // namespace slant

// What a camera makes of one point of the sampling pattern.
#pragma once
#include <glm/glm.hpp>

namespace slant {

/// A ray in world space whose parameter is the camera-space depth: origin + w * direction has depth w.
struct CameraRay {
    glm::vec3 origin, direction;
};

struct CameraSample {
    CameraRay ray;
    glm::vec2 lens; ///< lens position (u, v) in the unit disc: to the right and down, like the raster
    float weight;   ///< of the radiance along the ray; 0: no light gets through, and there is no ray
};

} // namespace slant

// What passes between the geometry side of the tracer (Embree) and its shading side.
#pragma once
#include <glm/glm.hpp>
#include <limits>

namespace slant {

/// World space. `direction` need not be of unit length for camera rays; it is for all others.
struct Ray {
    glm::vec3 origin{0};
    glm::vec3 direction{0, 0, 1};
    float tMax = std::numeric_limits<float>::infinity();
    float time = 0; ///< shutter time in [0, 1)
};

/// Which emitting surface piece was hit, for multiple importance sampling.
struct EmitterId {
    int light =
        -1; ///< index into Lights' list of emitters (one a shape with an area light); -1 = does not emit
    int primitive = 0; ///< triangle or patch of the mesh; 0 for quadrics
    bool operator==(const EmitterId&) const = default;
};

/// Where a ray met a surface; world space.
struct SurfaceHit {
    float t = 0;
    glm::vec3 position{0};
    glm::vec3 geometricNormal{
        0}; ///< unit; pbrt's n: flipped by ReverseOrientation, handedness and shading normals
    glm::vec3 shadingNormal{0}; ///< unit; on the side of pbrt's ns
    glm::vec3 dpdu{0};          ///< not normalised
    glm::vec2 uv{0};
    glm::vec3 positionError{0}; ///< bound on |error| of each coordinate, for offsetting new rays
    int materialIndex = -1;
    EmitterId emitter;
};

} // namespace slant

// What passes between the geometry side of the tracer (Embree) and its shading side.
#pragma once
#include <bit>
#include <cstdint>
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
    /// Index into Lights' list of emitters: those of Scene::shapes with an area light, counted in their order
    /// (shapes of object definitions never emit). -1 = does not emit.
    int light = -1;
    int primitive = 0; ///< triangle or patch of the mesh; 0 for quadrics
    bool operator==(const EmitterId&) const = default;
};

/// Where a ray met a surface; world space.
struct SurfaceHit {
    float t = std::numeric_limits<float>::infinity(); ///< infinity where nothing was hit
    glm::vec3 position{0};
    glm::vec3 geometricNormal{
        0}; ///< unit; pbrt's n: flipped by ReverseOrientation, handedness, shading normals
    glm::vec3 shadingNormal{0}; ///< unit; pbrt's ns: on the side of geometricNormal
    glm::vec3 dpdu{0}, dpdv{0}; ///< pbrt's shading ones; not normalised
    glm::vec2 uv{0};
    glm::vec3 positionError{0}; ///< bound on |error| of each coordinate, for offsetting new rays
    int materialIndex = -1;
    int alpha = -1; ///< Shape::alpha
    EmitterId emitter;
    float time = 0; ///< of the ray
    int mover = -1; ///< how it moves (Geometry::placement); -1: it keeps still

    bool hit() const { return materialIndex >= 0; }
};

/// Origin of a ray that leaves a surface along w without meeting it again: beyond the error bounds of the
/// position on the side of w (Pharr, Jakob, Humphreys: Physically Based Rendering, "Robust spawned ray
/// origins").
inline glm::vec3 offsetRayOrigin(glm::vec3 position, glm::vec3 positionError, glm::vec3 normal, glm::vec3 w) {
    // All axes count, not only those along the normal: Embree's own rounding grows with the size of the
    // triangle, also where its plane is exact (a floor at y = 0).
    float distance = positionError.x + positionError.y + positionError.z;
    if (glm::dot(w, normal) < 0) distance = -distance;
    glm::vec3 origin = position + distance * normal;
    for (int axis = 0; axis < 3; ++axis) { // round away from the surface
        float step = distance * normal[axis];
        if (step == 0) continue;
        float& value = origin[axis];
        if (value == 0)
            value = step > 0 ? std::numeric_limits<float>::denorm_min()
                             : -std::numeric_limits<float>::denorm_min();
        else
            value = std::bit_cast<float>(std::bit_cast<std::uint32_t>(value) +
                                         ((step > 0) == (value > 0) ? 1u : ~0u));
    }
    return origin;
}

/// Transforms a point from object space to world space; every user of a shape's vertices must round them
/// alike.
inline glm::vec3 transformPoint(const glm::dmat4& worldFromObject, glm::vec3 p) {
    return glm::vec3(worldFromObject * glm::dvec4(p, 1.0));
}

} // namespace slant

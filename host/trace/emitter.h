// One piece of a light with a place: a point, a triangle, a bilinear patch, a sphere or another quadric, and
// how to sample it from a receiving point.
#pragma once
#include "trace/point_profile.h"
#include "trace/profile.h"
#include "trace/warp.h"

#include <span>

namespace slant {

/// A surface point that asks for light: bidirectional scattering happens on the side of the normal only.
struct Receiver {
    glm::vec3 position{0};
    glm::vec3 normal{0, 0, 1}; ///< unit shading normal on the side of the path so far
    float time = 0;            ///< of the shutter
};

/// A direction towards a light, as seen from a receiver.
struct LightSample {
    glm::vec3 direction{0, 0, 1}; ///< unit
    float distance = 0;           ///< infinity for lights without a place
    glm::vec3 radiance{0};        ///< delta lights: irradiance on a surface that faces them
    float pdf = 0;        ///< over solid angle, times the chance of the light; delta lights: that chance
    bool delta = false;   ///< cannot be hit by a ray
    bool bounded = false; ///< radiance / pdf is bounded: needs no second strategy on diffuse surfaces
};

/// A quadric that is not sampled by its solid angle: all but whole spheres that are not stretched.
struct EmitterQuadric {
    glm::mat4 worldFromObject{1}, objectFromWorld{1};
    std::optional<Profile> profile{};              ///< all but disks
    float radius = 1, innerRadius = 0, height = 0; ///< disk: z = height
    float phiMax = 2 * kPi;
};

/// World space; `radiance` leaves on the side of the normal, or on both.
struct Emitter {
    enum class Shape { point, triangle, patch, sphere, quadric };
    Shape shape = Shape::point;
    bool twoSided = false;
    bool sampled = true;          ///< false: only rays find it
    glm::vec3 radiance{0};        ///< point: intensity
    glm::vec3 origin{0};          ///< point, first vertex or centre
    glm::vec3 edge1{0}, edge2{0}; ///< to the second and third vertex (patch: p10, p01)
    glm::vec3 twist{0};           ///< patch: p11 - p10 - p01 + p00
    glm::vec3 normal{0, 0, 1};    ///< triangle: unit; others: unused
    float side = 1;               ///< patch, sphere, quadric: -1 if the emitting normal is turned round
    float radius = 0;             ///< sphere
    float area = 0;
    float size2 = 0; ///< triangle: square of the longest edge
    int quadric = -1;
    const PointProfile* profile =
        nullptr;            ///< point: in place of the same intensity everywhere, times radiance
    bool invisible = false; ///< rays do not meet it
    int motion = -1;        ///< -1: it keeps still; else all of this is as at time 0

    /// A light that is not bounded is sampled by area: fine from far away, noisy from nearby.
    bool bounded() const { return shape != Shape::patch && shape != Shape::quadric; }
};

/// False if no light comes that way. `sample.pdf` is the density over solid angle alone.
bool sampleEmitter(const Emitter& emitter, std::span<const EmitterQuadric> quadrics, const Receiver& receiver,
                   glm::vec2 u, LightSample& sample);

/// Density with which sampleEmitter returns `direction`, which meets the emitter at `position`, where its
/// unit normal (either side) is `normal`.
float emitterPdf(const Emitter& emitter, std::span<const EmitterQuadric> quadrics, const Receiver& receiver,
                 glm::vec3 direction, glm::vec3 position, glm::vec3 normal);

/// Area in world space of the part of a quadric that exists.
float quadricArea(const EmitterQuadric& quadric);

} // namespace slant

// How the intensity of a light with a place depends on the direction: pbrt-v4's spot, goniometric and
// projection lights.
#pragma once
#include "scene/scene.h"

namespace slant {

/// Keeps a pointer to the light's image, which must live longer.
class PointProfile {
public:
    /// Throws Error(badInput) for an image or a transform that cannot be used.
    PointProfile(const Scene& scene, const Light& light);

    /// In place of Light::emission, without its scale, towards `direction` (unit, world space).
    glm::vec3 intensity(glm::vec3 direction) const;
    /// Mean over all directions.
    glm::vec3 mean() const { return mean_; }
    /// What turns the mean into pbrt's power for a power of 1: its estimate of the whole.
    float powerOfOne() const { return powerOfOne_; }

private:
    glm::vec3 texel(glm::vec2 st) const;
    glm::vec3 projected(glm::vec3 w) const;
    void sumImage();

    LightKind kind_;
    glm::vec3 emission_;
    glm::mat3 lightFromWorld_;
    float cosOuter_ = 0, cosInner_ = 0; ///< spot
    const Image* image_ = nullptr;      ///< the others; none: black for pbrt
    glm::vec2 screen_{1};               ///< projection: half of what its image covers at a distance of 1
    glm::vec3 mean_{0};
    float powerOfOne_ = 1;
};

} // namespace slant

// The surfaces of a scene and the rays that hit them: Embree finds the primitive, our own arithmetic
// (surface.h) the point on it. Embree is seen by geometry.cpp, body.h, instance.h and embree*.h alone.
#pragma once
#include "base/monitor.h"
#include "scene/scene.h"
#include "trace/interaction.h"
#include "trace/surface.h"

#include <cstdint>
#include <memory>
#include <span>

namespace slant {

class Placement;

// Surfaces with an alpha stop a ray by a number that is made of its origin and direction, as in pbrt; where
// they do not, it goes on from there.
class Geometry {
public:
    /// The scene must outlive the geometry. Throws Error(badInput) for shapes that cannot be used, with their
    /// location, Error(resources) when memory runs out, and what the monitor throws.
    Geometry(const Scene& scene, Monitor& monitor);
    ~Geometry();
    Geometry(const Geometry&) = delete;
    Geometry& operator=(const Geometry&) = delete;

    /// The nearest surface with 0 < t < ray.tMax; false (and `hit` as constructed) if there is none.
    bool intersect(const Ray& ray, SurfaceHit& hit) const;
    /// Whether any surface lies at 0 < t < ray.tMax.
    bool occluded(const Ray& ray) const;

    /// The same for many rays that lie near each other, in order; faster. Rays with tMax <= 0 are left out:
    /// no hit.
    void intersect(std::span<const Ray> rays, std::span<SurfaceHit> hits) const;
    /// occluded[i] = 1 or 0.
    void occluded(std::span<const Ray> rays, std::span<std::uint8_t> occluded) const;

    /// The distance of the nearest surface, infinity if there is none.
    void distances(std::span<const Ray> rays, std::span<float> distances) const;

    /// World bounds of everything, wherever it moves; empty for an empty scene.
    Box bounds() const;

    /// What moves: SurfaceHit::mover is one of so many numbers.
    std::size_t moverCount() const;
    const Placement& placement(int mover) const;

private:
    bool nearest(const Ray& ray, SurfaceHit& hit) const;
    void passMasked(const Ray& ray, SurfaceHit& hit) const;

    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace slant

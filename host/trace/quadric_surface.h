// Spheres, disks, cylinders, cones, hyperboloids and paraboloids, whole or partial, as pbrt defines them.
#pragma once
#include "trace/profile.h"
#include "trace/surface.h"

namespace slant {

class QuadricSurface final : public Surface, public UserSurface {
public:
    explicit QuadricSurface(const Shape& shape);

    std::uint32_t primitiveCount() const override { return 1; }
    Box bounds(std::uint32_t) const override { return bounds_; }
    std::optional<SurfaceLocation> intersect(std::uint32_t, const SurfaceRay& ray,
                                             double tMax) const override;
    SurfaceLocation locate(const FoundHit& found, const SurfaceRay& ray) const override;
    void describe(std::uint32_t, const SurfaceLocation& at, SurfaceHit& hit) const override;

private:
    std::optional<SurfaceLocation> intersectSphere(const SurfaceRay& objectRay, double tMax) const;
    std::optional<SurfaceLocation> intersectTurned(const SurfaceRay& objectRay, double tMax) const;
    std::optional<SurfaceLocation> intersectDisk(const SurfaceRay& objectRay, double tMax) const;
    double phiOf(glm::dvec3 p) const;
    bool insidePhi(glm::dvec3 p) const;

    ShapeKind kind_;
    double radius_, phiMax_;
    Profile profile_;              ///< all but disks
    double thetaZMin_, thetaZMax_; ///< sphere
    double height_, innerRadius_;  ///< disk
    bool flip_, whole_;
    glm::dmat3 linear_, inverseLinear_, normalMatrix_;
    glm::dvec3 offset_;
    Box bounds_;
};

} // namespace slant

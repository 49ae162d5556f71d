// Triangle meshes and meshes of bilinear patches, with pbrt's parametrisation and rules for normals.
#pragma once
#include "trace/surface.h"

#include <vector>

namespace slant {

/// What both kinds share: vertices in the group's space.
class MeshSurface : public Surface {
public:
    std::uint32_t primitiveCount() const override { return std::uint32_t(mesh_.indices.size()) / corners_; }
    Box bounds(std::uint32_t primitive) const override;

    /// One vector past the last vertex may be read (Embree reads 16 bytes at a time).
    const std::vector<glm::vec3>& paddedPositions() const { return positions_; }
    const std::vector<std::uint32_t>& indices() const { return mesh_.indices; }

protected:
    /// Throws Error(badInput) for indices out of range or attributes that do not match the positions.
    MeshSurface(const Shape& shape, const Mesh& mesh, std::uint32_t corners);
    const std::uint32_t* corner(std::uint32_t primitive) const {
        return &mesh_.indices[primitive * corners_];
    }

    const Mesh& mesh_;
    std::uint32_t corners_;
    std::vector<glm::vec3> positions_, normals_;
    bool flip_;
};

class TriangleSurface final : public MeshSurface {
public:
    TriangleSurface(const Shape& shape, const Mesh& mesh) : MeshSurface(shape, mesh, 3) {}
    /// Takes it as known that the line meets the triangle (Embree's word), and answers with the nearest point
    /// of it.
    std::optional<SurfaceLocation> intersect(std::uint32_t primitive, const SurfaceRay& ray,
                                             double tMax) const override;
    void describe(std::uint32_t primitive, const SurfaceLocation& at, SurfaceHit& hit) const override;
};

class BilinearSurface final : public MeshSurface {
public:
    BilinearSurface(const Shape& shape, const Mesh& mesh) : MeshSurface(shape, mesh, 4) {}
    std::optional<SurfaceLocation> intersect(std::uint32_t primitive, const SurfaceRay& ray,
                                             double tMax) const override;
    void describe(std::uint32_t primitive, const SurfaceLocation& at, SurfaceHit& hit) const override;
};

} // namespace slant

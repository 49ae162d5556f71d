// Triangle meshes and meshes of bilinear patches, with pbrt's parametrisation and rules for normals.
#pragma once
#include "trace/surface.h"

#include <vector>

namespace slant {

/// What both kinds share: vertices in the group's space.
class MeshSurface : public Surface {
public:
    /// One vector past the last vertex may be read (Embree reads 16 bytes at a time).
    const std::vector<glm::vec3>& paddedPositions() const { return positions_; }
    /// The triangles that Embree searches, three indices each.
    virtual const std::vector<std::uint32_t>& triangles() const = 0;

protected:
    /// Throws Error(badInput) for indices out of range or attributes that do not match the positions.
    MeshSurface(const Shape& shape, const Mesh& mesh, std::uint32_t corners);
    const std::uint32_t* corner(std::uint32_t primitive) const {
        return &mesh_.indices[std::size_t(primitive) * corners_];
    }

    const Mesh& mesh_;
    std::uint32_t corners_;
    std::vector<glm::vec3> positions_, normals_;
    bool flip_;
};

class TriangleSurface final : public MeshSurface {
public:
    TriangleSurface(const Shape& shape, const Mesh& mesh) : MeshSurface(shape, mesh, 3) {}
    const std::vector<std::uint32_t>& triangles() const override { return mesh_.indices; }
    SurfaceLocation locate(const FoundHit& found, const SurfaceRay& ray) const override;
    void describe(std::uint32_t primitive, const SurfaceLocation& at, SurfaceHit& hit) const override;
};

/// Where all patches are flat and convex Embree searches two triangles for each, which is faster.
class BilinearSurface final : public MeshSurface, public UserSurface {
public:
    BilinearSurface(const Shape& shape, const Mesh& mesh);
    bool flat() const { return !halves_.empty(); }
    const std::vector<std::uint32_t>& triangles() const override { return halves_; }
    std::uint32_t primitiveCount() const override { return std::uint32_t(mesh_.indices.size() / corners_); }
    Box bounds(std::uint32_t primitive) const override;
    std::optional<SurfaceLocation> intersect(std::uint32_t primitive, const SurfaceRay& ray,
                                             double tMax) const override;
    std::uint32_t meshPrimitive(std::uint32_t embreePrimitive) const override {
        return flat() ? embreePrimitive / 2 : embreePrimitive;
    }
    SurfaceLocation locate(const FoundHit& found, const SurfaceRay& ray) const override;
    void describe(std::uint32_t primitive, const SurfaceLocation& at, SurfaceHit& hit) const override;

private:
    bool isFlat(std::uint32_t primitive) const;

    std::vector<std::uint32_t> halves_; ///< empty unless all patches are flat
};

} // namespace slant

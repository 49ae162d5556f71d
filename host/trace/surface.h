// Shapes as sets of primitives that rays meet: the exact geometry behind Embree's search, in our own double
// precision, so that hit points do not depend on the processor's instruction set or on packet neighbours.
#pragma once
#include "scene/scene.h"
#include "trace/interaction.h"

#include <glm/glm.hpp>
#include <memory>
#include <optional>

namespace slant {

struct SurfaceRay {
    glm::dvec3 origin, direction;
};

/// Where a ray meets a primitive.
struct SurfaceLocation {
    double t;
    /// Barycentric coordinates of a triangle; (u, v, -) of a bilinear patch; the point of a quadric in its
    /// own object space.
    glm::dvec3 local;
};

struct Box {
    glm::vec3 min{std::numeric_limits<float>::infinity()}, max{-std::numeric_limits<float>::infinity()};

    bool empty() const { return !(min.x <= max.x); }
    void extend(glm::vec3 p) {
        min = glm::min(min, p);
        max = glm::max(max, p);
    }
};

/// What Embree found, in its own float arithmetic.
struct FoundHit {
    std::uint32_t primitive; ///< Embree's
    float t;
    glm::vec2 barycentric; ///< of triangles: weights of the second and third vertex
    glm::vec3 local;       ///< of user geometries: SurfaceLocation::local
};

/// One shape of the scene in the space of its group: the world, or that of an object definition. Immutable,
/// and refers into the Scene, which must outlive it.
class Surface {
public:
    virtual ~Surface() = default;

    /// The triangle or patch of the mesh, 0 of a quadric, that Embree's primitive belongs to.
    virtual std::uint32_t meshPrimitive(std::uint32_t embreePrimitive) const { return embreePrimitive; }
    /// The point that Embree found, computed anew; `ray` as far as possible without Embree's rounding.
    virtual SurfaceLocation locate(const FoundHit& found, const SurfaceRay& ray) const = 0;
    /// Position, error bound, normals, dpdu and uv of `hit`, in the group's space.
    virtual void describe(std::uint32_t primitive, const SurfaceLocation& at, SurfaceHit& hit) const = 0;
};

/// A surface that intersects rays itself, as a user geometry of Embree.
class UserSurface {
public:
    virtual ~UserSurface() = default;

    virtual std::uint32_t primitiveCount() const = 0;
    virtual Box bounds(std::uint32_t primitive) const = 0;
    /// The nearest hit with 0 < t < tMax.
    virtual std::optional<SurfaceLocation> intersect(std::uint32_t primitive, const SurfaceRay& ray,
                                                     double tMax) const = 0;
};

/// Bound on the relative error of n rounded float operations.
constexpr float gammaBound(int n) {
    return float(n) * 0x1p-24f / (1 - float(n) * 0x1p-24f);
}

/// Throws Error(badInput) unless the matrix can be inverted.
void requireInvertible(const glm::dmat4& matrix, const FileLocation& location);

/// Whether normals of a shape point the other way: pbrt's ReverseOrientation xor a mirroring transform.
bool flipsNormals(const Shape& shape);

} // namespace slant

#include "trace/mesh_surface.h"

#include "trace/tangent_frame.h"

#include <algorithm>
#include <cmath>

namespace slant {
namespace {

/// Patches extend this far beyond their edges, so that no ray slips between neighbours because of rounding.
constexpr double kSeam = 1e-9;

/// Real roots of a u^2 + b u + c = 0, without cancellation; false if there are none.
bool solveQuadratic(double a, double b, double c, double roots[2]) {
    if (a == 0) {
        if (b == 0) return false;
        roots[0] = roots[1] = -c / b;
        return true;
    }
    double discriminant = b * b - 4 * a * c;
    if (!(discriminant >= 0)) return false;
    double q = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
    roots[0] = q / a;
    roots[1] = q == 0 ? roots[0] : c / q;
    return true;
}

/// `vector` after the shortest rotation of one unit vector onto another.
glm::dvec3 turned(glm::dvec3 vector, glm::dvec3 from, glm::dvec3 to) {
    glm::dvec3 axis = glm::cross(from, to);
    double cosine = glm::dot(from, to);
    if (cosine < -0.999999) return -vector; // about opposite: half a turn around any axis
    return vector + glm::cross(axis, vector) + glm::cross(axis, glm::cross(axis, vector)) / (1 + cosine);
}

} // namespace

BilinearSurface::BilinearSurface(const Shape& shape, const Mesh& mesh) : MeshSurface(shape, mesh, 4) {
    for (std::uint32_t i = 0; i < primitiveCount(); ++i)
        if (!isFlat(i)) return;
    halves_.reserve(std::size_t(primitiveCount()) * 6);
    for (std::uint32_t i = 0; i < primitiveCount(); ++i) {
        const std::uint32_t* v = corner(i);
        halves_.insert(halves_.end(), {v[0], v[1], v[3], v[0], v[3], v[2]});
    }
}

/// Flat but for the rounding of its vertices, and convex.
bool BilinearSurface::isFlat(std::uint32_t primitive) const {
    const std::uint32_t* v = corner(primitive);
    const glm::dvec3 ring[4] = {positions_[v[0]], positions_[v[1]], positions_[v[3]], positions_[v[2]]};
    glm::dvec3 normal = glm::cross(ring[2] - ring[0], ring[3] - ring[1]), size(0);
    const double length = glm::length(normal);
    if (!(length > 0)) return false;
    normal /= length;
    for (glm::dvec3 p : ring) size = glm::max(size, glm::abs(p));
    if (std::abs(glm::dot(normal, ring[1] - ring[0])) >
        double(gammaBound(4)) * glm::dot(glm::abs(normal), size))
        return false;
    for (int k = 0; k < 4; ++k)
        if (!(glm::dot(glm::cross(ring[(k + 1) % 4] - ring[k], ring[(k + 2) % 4] - ring[(k + 1) % 4]),
                       normal) > 0))
            return false;
    return true;
}

Box BilinearSurface::bounds(std::uint32_t primitive) const {
    Box box;
    for (std::uint32_t k = 0; k < corners_; ++k) box.extend(positions_[corner(primitive)[k]]);
    return box;
}

SurfaceLocation BilinearSurface::locate(const FoundHit& found, const SurfaceRay& ray) const {
    auto location = intersect(meshPrimitive(found.primitive), ray, std::numeric_limits<double>::infinity());
    if (location) return *location;
    // Embree just hit what this test misses: it rounds rays in instances, and the edges of triangles.
    if (!flat()) return {found.t, found.local};
    glm::vec2 b = found.barycentric; // of (0, 0), (1, 0), (1, 1) or (0, 0), (1, 1), (0, 1)
    return {found.t,
            found.primitive % 2 == 0 ? glm::dvec3(b.x + b.y, b.y, 0) : glm::dvec3(b.x, b.x + b.y, 0)};
}

// Reshetov, "Cool Patches: A Geometric Approach to Ray/Bilinear Patch Intersections", 2019: the straight
// lines of constant u that the ray's line meets are the roots of a quadratic.
std::optional<SurfaceLocation> BilinearSurface::intersect(std::uint32_t primitive, const SurfaceRay& ray,
                                                          double tMax) const {
    const std::uint32_t* v = corner(primitive);
    glm::dvec3 p00 = glm::dvec3(positions_[v[0]]) - ray.origin,
               p10 = glm::dvec3(positions_[v[1]]) - ray.origin;
    glm::dvec3 p01 = glm::dvec3(positions_[v[2]]) - ray.origin,
               p11 = glm::dvec3(positions_[v[3]]) - ray.origin;
    glm::dvec3 d = ray.direction;
    double a = glm::dot(glm::cross(p10 - p00, p01 - p11), d);
    double c = glm::dot(glm::cross(p00, d), p01 - p00);
    double b = glm::dot(glm::cross(p10, d), p11 - p10) - (a + c);
    double roots[2];
    if (!solveQuadratic(a, b, c, roots)) return std::nullopt;

    std::optional<SurfaceLocation> nearest;
    for (double root : roots) {
        if (!(root >= -kSeam && root <= 1 + kSeam)) continue;
        const double u = std::clamp(root, 0.0, 1.0);
        glm::dvec3 start = p00 + u * (p10 - p00), along = p01 + u * (p11 - p01) - start;
        // Where the line of constant u and the ray come nearest to each other.
        glm::dvec3 across = glm::cross(d, along);
        double squared = glm::dot(across, across);
        double vScaled = glm::dot(glm::cross(start, d), across);
        double t = glm::dot(glm::cross(start, along), across) / squared;
        double vHere = vScaled / squared;
        if (!(vHere >= -kSeam && vHere <= 1 + kSeam && t > 0 && t < tMax)) continue;
        if (!nearest || t < nearest->t) nearest = SurfaceLocation{t, {u, std::clamp(vHere, 0.0, 1.0), 0}};
    }
    return nearest;
}

void BilinearSurface::describe(std::uint32_t primitive, const SurfaceLocation& at, SurfaceHit& hit) const {
    const std::uint32_t* corners = corner(primitive);
    auto interpolate = [&](auto c00, auto c10, auto c01, auto c11) {
        double u = at.local.x, v = at.local.y;
        return (1 - u) * ((1 - v) * c00 + v * c01) + u * ((1 - v) * c10 + v * c11);
    };
    auto alongU = [&](auto c00, auto c10, auto c01, auto c11) {
        return (1 - at.local.y) * (c10 - c00) + at.local.y * (c11 - c01);
    };
    auto alongV = [&](auto c00, auto c10, auto c01, auto c11) {
        return (1 - at.local.x) * (c01 - c00) + at.local.x * (c11 - c10);
    };
    auto apply = [&](const auto& function, const auto& values, auto type) {
        using Vector = decltype(type);
        return function(Vector(values[corners[0]]), Vector(values[corners[1]]), Vector(values[corners[2]]),
                        Vector(values[corners[3]]));
    };
    hit.position = apply(interpolate, positions_, glm::dvec3());
    // Embree works in float on the vertices of triangles, so their size bounds its error.
    auto sizes = [&](auto... values) { return interpolate(glm::abs(values)...); };
    hit.positionError = flat() ? gammaBound(9) * glm::vec3(apply(sizes, positions_, glm::dvec3()))
                               : gammaBound(2) * glm::abs(hit.position);
    glm::dvec3 dpdu = apply(alongU, positions_, glm::dvec3()), dpdv = apply(alongV, positions_, glm::dvec3());
    glm::dvec3 normal = glm::cross(dpdu, dpdv);
    double length = glm::length(normal);
    normal = length > 0 ? normal / length : anyTangent({0, 0, 1});
    if (flip_) normal = -normal;

    hit.uv = glm::vec2(at.local);
    if (!mesh_.uvs.empty()) {
        hit.uv = apply(interpolate, mesh_.uvs, glm::dvec2());
        // pbrt's derivative with respect to the mesh's first texture coordinate: a reciprocal of each
        // partial.
        const glm::dvec2 alongFirst = apply(alongU, mesh_.uvs, glm::dvec2()),
                         alongSecond = apply(alongV, mesh_.uvs, glm::dvec2());
        const auto derivative = [&](int axis) {
            glm::dvec3 sum(0);
            if (std::abs(alongFirst[axis]) >= 1e-8) sum += dpdu / alongFirst[axis];
            if (std::abs(alongSecond[axis]) >= 1e-8) sum += dpdv / alongSecond[axis];
            return sum;
        };
        const glm::dvec3 dpds = derivative(0), dpdt = derivative(1);
        if (const glm::dvec3 cross = glm::cross(dpds, dpdt); glm::dot(cross, cross) > 0)
            dpdv = glm::dot(cross, glm::cross(dpdu, dpdv)) < 0 ? -dpdt : dpdt;
        if (glm::dot(dpds, dpds) > 0) dpdu = dpds;
    }
    if (!(glm::dot(dpdu, dpdu) > 0)) dpdu = anyTangent(normal);

    glm::dvec3 shading = normal;
    if (!normals_.empty()) {
        glm::dvec3 sum = apply(interpolate, normals_, glm::dvec3());
        double size = glm::length(sum);
        if (size > 0) shading = sum / size;
        dpdu = turned(dpdu, normal, shading);
        dpdv = turned(dpdv, normal, shading);
        if (glm::dot(normal, shading) < 0) normal = -normal;
    }
    hit.geometricNormal = normal;
    hit.shadingNormal = shading;
    hit.dpdu = dpdu;
    hit.dpdv = dpdv;
}

} // namespace slant

#include "trace/mesh_surface.h"

#include "trace/tangent_frame.h"

#include <cmath>

namespace slant {

// Trusts Embree that the ray hits the triangle, and returns its point that is nearest to the ray.
SurfaceLocation TriangleSurface::locate(const FoundHit& found, const SurfaceRay& ray) const {
    const std::uint32_t* v = corner(found.primitive);
    // Edge functions as seen from the origin (Plücker).
    glm::dvec3 p0 = glm::dvec3(positions_[v[0]]) - ray.origin;
    glm::dvec3 p1 = glm::dvec3(positions_[v[1]]) - ray.origin;
    glm::dvec3 p2 = glm::dvec3(positions_[v[2]]) - ray.origin;
    glm::dvec3 b(glm::dot(ray.direction, glm::cross(p1, p2)), glm::dot(ray.direction, glm::cross(p2, p0)),
                 glm::dot(ray.direction, glm::cross(p0, p1)));
    double determinant = b.x + b.y + b.z;
    b = determinant == 0 ? glm::dvec3(1.0 / 3) : glm::max(b / determinant, glm::dvec3(0));
    b /= b.x + b.y + b.z;
    glm::dvec3 meeting = b.x * p0 + b.y * p1 + b.z * p2;
    return {glm::dot(meeting, ray.direction) / glm::dot(ray.direction, ray.direction), b};
}

void TriangleSurface::describe(std::uint32_t primitive, const SurfaceLocation& at, SurfaceHit& hit) const {
    const std::uint32_t* v = corner(primitive);
    glm::dvec3 b = at.local, p0(positions_[v[0]]), p1(positions_[v[1]]), p2(positions_[v[2]]);
    hit.position = b.x * p0 + b.y * p1 + b.z * p2;
    // Embree works in float on the vertices, so their size bounds its error.
    hit.positionError =
        gammaBound(7) * glm::vec3(b.x * glm::abs(p0) + b.y * glm::abs(p1) + b.z * glm::abs(p2));

    glm::dvec3 p02 = p0 - p2, p12 = p1 - p2;
    glm::dvec3 normal = glm::cross(p02, p12);
    double length = glm::length(normal);
    normal = length > 0 ? normal / length : glm::dvec3(0, 0, 1);
    if (flip_) normal = -normal;

    glm::dvec2 uv[3] = {{0, 0}, {1, 0}, {1, 1}};
    if (!mesh_.uvs.empty())
        for (int k = 0; k < 3; ++k) uv[k] = mesh_.uvs[v[k]];
    hit.uv = b.x * uv[0] + b.y * uv[1] + b.z * uv[2];
    glm::dvec2 uv02 = uv[0] - uv[2], uv12 = uv[1] - uv[2];
    double determinant = uv02.x * uv12.y - uv02.y * uv12.x;
    glm::dvec3 dpdu(0), dpdv(0);
    if (std::abs(determinant) >= 1e-9) {
        dpdu = (uv12.y * p02 - uv02.y * p12) / determinant;
        dpdv = (uv02.x * p12 - uv12.x * p02) / determinant;
    }
    if (!(glm::dot(dpdu, dpdu) > 0)) {
        dpdu = anyTangent(normal);
        dpdv = glm::cross(normal, dpdu);
    }

    glm::dvec3 shading = normal;
    if (!normals_.empty()) {
        glm::dvec3 sum = b.x * glm::dvec3(normals_[v[0]]) + b.y * glm::dvec3(normals_[v[1]]) +
                         b.z * glm::dvec3(normals_[v[2]]);
        double size = glm::length(sum);
        if (size > 0) shading = sum / size;
        if (glm::dot(normal, shading) < 0) normal = -normal;
        dpdu = tangentAcross(dpdu, shading);
        dpdv = glm::cross(shading, dpdu);
    }
    hit.geometricNormal = normal;
    hit.shadingNormal = shading;
    hit.dpdu = dpdu;
    hit.dpdv = dpdv;
}

} // namespace slant

#include "trace/specular_chain.h"

#include <algorithm>
#include <array>

namespace slant {
namespace {

/// Vertices after which a chain is cut: light that is trapped in glass.
constexpr int kMaxLength = 16;
/// Normals of neighbouring rays are nearer to one another than this cosine, or they met other things.
constexpr float kSameSurface = 0.8f;
/// How far away neighbouring rays leave the lens, in its radii: curved surfaces are to be seen as the lens sees them,
/// not as if it were small.
constexpr double kNeighbour = 0.5;
/// No image is taken to lie nearer than this part of the depth of the first surface.
constexpr double kNearestImage = 1.0 / 8;

class SpecularChain {
public:
    SpecularChain(const Geometry& geometry, const Materials& materials, const Ray& cameraRay,
                  const SurfaceHit& hit)
        : geometry_(geometry), materials_(materials) {
        last_ = cameraRay;
        end_ = hit;
        while (count_ < kMaxLength && end_.hit()) {
            const Bsdf bsdf = materials_.bsdf(end_, -glm::normalize(last_.direction));
            if (!bsdf.specular()) break;
            Vertex& vertex = vertices_[std::size_t(count_++)];
            vertex = {end_.materialIndex, bsdf.mostlyReflects(), bsdf.normal()};
            last_ = sentOn(last_, end_, bsdf.specularDirection(vertex.reflects));
            geometry_.intersect(last_, end_);
        }
    }
    bool empty() const { return count_ == 0; }

    /// Where a neighbouring camera ray passes the end of the chain, across the last ray; far away, in what
    /// direction.
    std::optional<glm::dvec2> displacement(Ray ray) const {
        for (int i = 0; i < count_; ++i) {
            const Vertex& vertex = vertices_[std::size_t(i)];
            SurfaceHit hit;
            if (!geometry_.intersect(ray, hit) || hit.materialIndex != vertex.materialIndex) return {};
            const Bsdf bsdf = materials_.bsdf(hit, -glm::normalize(ray.direction));
            if (!bsdf.specular() || glm::dot(bsdf.normal(), vertex.normal) < kSameSurface) return {};
            const glm::vec3 next = bsdf.specularDirection(vertex.reflects);
            if (next == glm::vec3(0)) return {};
            ray = sentOn(ray, hit, next);
        }
        const glm::dvec3 along = glm::normalize(glm::dvec3(last_.direction));
        const Frame frame = Frame::around(glm::vec3(along));
        glm::dvec3 d(ray.direction);
        if (!(glm::dot(d, along) > 0)) return {};
        d /= glm::dot(d, along);
        glm::dvec3 beside = d - along;
        if (end_.hit()) {
            const glm::dvec3 way = glm::dvec3(end_.position) - glm::dvec3(ray.origin);
            beside = glm::dot(way, along) * d - way;
        }
        return glm::dvec2(glm::dot(beside, glm::dvec3(frame.x)), glm::dot(beside, glm::dvec3(frame.y)));
    }

private:
    struct Vertex {
        int materialIndex;
        bool reflects;
        glm::vec3 normal; ///< of shading, where the ray came from
    };
    static Ray sentOn(const Ray& ray, const SurfaceHit& hit, glm::vec3 direction) {
        return {offsetRayOrigin(hit.position, hit.positionError, hit.geometricNormal, direction), direction,
                std::numeric_limits<float>::infinity(), ray.time};
    }

    const Geometry& geometry_;
    const Materials& materials_;
    std::array<Vertex, kMaxLength> vertices_;
    int count_ = 0;
    Ray last_;
    SurfaceHit end_;
};

} // namespace

std::optional<float> imageDepth(const Geometry& geometry, const Materials& materials, const Ray& cameraRay,
                                const SurfaceHit& hit, const LensAxes& axes) {
    const SpecularChain chain(geometry, materials, cameraRay, hit);
    if (chain.empty()) return {};
    // A column of a matrix: the mean of both sides, or that on which the neighbour stays within the chain.
    const auto column = [&](const glm::dvec3& axis, double onLens, double ofDirection) {
        glm::dvec2 sum(0);
        int sides = 0;
        for (const double sign : {1.0, -1.0}) {
            Ray ray = cameraRay;
            ray.origin = glm::vec3(glm::dvec3(ray.origin) + sign * onLens * axis);
            ray.direction = glm::vec3(glm::dvec3(ray.direction) + sign * ofDirection * axis);
            if (const auto moved = chain.displacement(ray)) {
                sum += *moved * (sign / (onLens + ofDirection));
                ++sides;
            }
        }
        return sides > 0 ? std::optional(sum / double(sides)) : std::nullopt;
    };
    const double shift = kNeighbour * axes.radius, turn = shift / double(hit.t);
    const auto a0 = column(axes.right, shift, 0), a1 = column(axes.down, shift, 0);
    const auto b0 = column(axes.right, 0, turn), b1 = column(axes.down, 0, turn);
    if (!a0 || !a1 || !b0 || !b1) return {};
    // Half of the trace of the inverse of B times A.
    const double determinant = b0->x * b1->y - b1->x * b0->y;
    const double trace = a0->x * b1->y - a0->y * b1->x + a1->y * b0->x - a1->x * b0->y;
    const double inverse = trace / (2 * determinant);
    if (!std::isfinite(inverse)) return {};
    return 1 / float(std::clamp(inverse, 0.0, 1 / (kNearestImage * double(hit.t))));
}

} // namespace slant

#include "trace/specular_chain.h"

#include <algorithm>
#include <array>
#include <optional>

namespace slant {
namespace {

/// Vertices after which a chain is cut: light that is trapped in glass.
constexpr int kMaxLength = 16;
/// How far away neighbouring rays leave the lens, in its radii: curved surfaces are to be seen as the lens
/// sees them, not as if it were small.
constexpr double kNeighbour = 0.5;
/// Normals of neighbouring rays are nearer to one another than this cosine, or they met other things.
constexpr float kSameSurface = 0.8f;
/// An image must leave at most this part of what the one before it leaves of the rays' squared distances:
/// behind a thick lens rays meet nowhere near one another.
constexpr double kWorthIt = 0.5;
/// Images are taken to lie between these multiples of the depth of the first surface.
constexpr double kNearestImage = 1.0 / 8, kFarthestImage = 256;

/// The ray that a specular surface sends on.
Ray sentOn(const Ray& ray, const SurfaceHit& hit, glm::vec3 direction) {
    return {offsetRayOrigin(hit.position, hit.positionError, hit.geometricNormal, direction), direction,
            std::numeric_limits<float>::infinity(), ray.time};
}

/// A camera ray and its neighbours, on their way through a chain.
class Bundle {
public:
    Bundle(const Geometry& geometry, const Materials& materials, const Ray& cameraRay, const SurfaceHit& hit,
           const LensAxes& axes)
        : geometry_(geometry), materials_(materials), ray_(cameraRay), hit_(hit),
          shift_(kNeighbour * axes.radius), turn_(shift_ / double(hit.t)) {
        for (std::size_t i = 0; i < neighbours_.size(); ++i) {
            Neighbour& n = neighbours_[i];
            const glm::dvec3 step = (i & 1 ? -1.0 : 1.0) * (i & 2 ? axes.down : axes.right);
            n.ray = cameraRay;
            if (i & 4)
                n.ray.direction = glm::vec3(glm::dvec3(n.ray.direction) + turn_ * step);
            else
                n.ray.origin = glm::vec3(glm::dvec3(n.ray.origin) + shift_ * step);
        }
    }

    /// Through the surface that has been met to the next; false if it scatters.
    bool advance() {
        if (!hit_.hit()) return false;
        const Bsdf bsdf = materials_.bsdf(hit_, -glm::normalize(ray_.direction));
        if (!bsdf.specular()) return false;
        for (Neighbour& n : neighbours_) n.follows = n.follows && follow(n.ray, bsdf);
        ray_ = sentOn(ray_, hit_, bsdf.specularDirection(bsdf.mostlyReflects()));
        geometry_.intersect(ray_, hit_);
        return true;
    }

    /// 1 / w of the image of what has been met, if it explains the neighbours far better than `other` does.
    std::optional<double> image(double other) const {
        glm::dmat2 turned(0);
        std::array<glm::dvec2, 4> shifted;
        glm::ivec2 turnedSides(0), shiftedSides(0);
        for (std::size_t i = 0; i < neighbours_.size(); ++i) {
            if (!neighbours_[i].follows) continue;
            const auto beside = displacement(neighbours_[i].ray);
            if (!beside) return {};
            const int axis = i & 2 ? 1 : 0;
            const double sign = i & 1 ? -1 : 1;
            if (i & 4) {
                turned[axis] += *beside * (sign / turn_);
                ++turnedSides[axis];
            } else {
                shifted[std::size_t(shiftedSides.x + shiftedSides.y)] = *beside * sign;
                ++shiftedSides[axis];
            }
        }
        if (glm::any(glm::equal(turnedSides, glm::ivec2(0))) ||
            glm::any(glm::equal(shiftedSides, glm::ivec2(0))))
            return {};
        for (int axis = 0; axis < 2; ++axis) turned[axis] /= double(turnedSides[axis]);
        const glm::dmat2 inverse = glm::inverse(turned);
        // In units of the shift: 1 / w along the axis, nothing across it.
        std::array<glm::dvec2, 4> ratios;
        const int count = shiftedSides.x + shiftedSides.y;
        glm::dvec2 sum(0);
        for (int k = 0; k < count; ++k) {
            const int axis = k < shiftedSides.x ? 0 : 1;
            ratios[std::size_t(k)] = inverse * shifted[std::size_t(k)] / shift_;
            sum[axis] += ratios[std::size_t(k)][axis] / double(shiftedSides[axis]);
        }
        const double mean = (sum.x + sum.y) / 2;
        const auto left = [&](double inverseDepth) {
            double squares = 0;
            for (int k = 0; k < count; ++k) {
                glm::dvec2 rest = ratios[std::size_t(k)];
                rest[k < shiftedSides.x ? 0 : 1] -= inverseDepth;
                squares += glm::dot(rest, rest);
            }
            return squares;
        };
        if (!(left(mean) <= kWorthIt * left(other))) return {};
        return mean;
    }

private:
    struct Neighbour { ///< bit 0: the other way, bit 1: downwards, bit 2: in another direction
        Ray ray;
        bool follows = true;
    };
    bool follow(Ray& ray, const Bsdf& surface) const {
        SurfaceHit hit;
        if (!geometry_.intersect(ray, hit) || hit.materialIndex != hit_.materialIndex) return false;
        const Bsdf bsdf = materials_.bsdf(hit, -glm::normalize(ray.direction));
        if (!bsdf.specular() || glm::dot(bsdf.normal(), surface.normal()) < kSameSurface) return false;
        const glm::vec3 next = bsdf.specularDirection(surface.mostlyReflects());
        ray = sentOn(ray, hit, next);
        return next != glm::vec3(0);
    }
    /// Where a neighbour passes what has been met, across the ray; far away, in what direction.
    std::optional<glm::dvec2> displacement(const Ray& neighbour) const {
        const glm::dvec3 along = glm::normalize(glm::dvec3(ray_.direction));
        const Frame frame = Frame::around(glm::vec3(along));
        glm::dvec3 d(neighbour.direction);
        if (!(glm::dot(d, along) > 0)) return {};
        d /= glm::dot(d, along);
        glm::dvec3 beside = d - along;
        if (hit_.hit()) {
            const glm::dvec3 way = glm::dvec3(hit_.position) - glm::dvec3(neighbour.origin);
            beside = glm::dot(way, along) * d - way;
        }
        return glm::dvec2(glm::dot(beside, glm::dvec3(frame.x)), glm::dot(beside, glm::dvec3(frame.y)));
    }

    const Geometry& geometry_;
    const Materials& materials_;
    Ray ray_;
    SurfaceHit hit_;
    double shift_, turn_;
    std::array<Neighbour, 8> neighbours_;
};

} // namespace

float imageDepth(const Geometry& geometry, const Materials& materials, const Ray& cameraRay,
                 const SurfaceHit& hit, const LensAxes& axes) {
    Bundle bundle(geometry, materials, cameraRay, hit, axes);
    const double surface = 1 / double(hit.t);
    double inverse = surface;
    for (int i = 0; i < kMaxLength && bundle.advance(); ++i) {
        const auto image = bundle.image(inverse);
        if (!image) break;
        inverse = *image;
    }
    return inverse == surface
               ? hit.t
               : 1 / float(std::clamp(inverse, surface / kFarthestImage, surface / kNearestImage));
}

} // namespace slant

#include "trace/sample_motion.h"

#include "trace/instance.h"

#include <algorithm>
#include <cmath>

namespace slant {
namespace {

/// Only times count at which the point is farther than this part of its own depth: beside the eye, and behind
/// it, there is no picture of it to miss.
constexpr double kNearest = 1.0 / 16;
/// Where no other time counts: the tangent, over this part of the shutter.
constexpr double kTangentStep = 1.0 / 64;
constexpr float kFirstPx = 1.f / 1024;

/// From one homogeneous position to others at other times.
template <std::size_t N>
struct Path {
    glm::dvec3 from;
    std::array<glm::dvec3, N> change;
    std::array<double, N> after; ///< times after the first

    bool counts(std::size_t k) const { return from.z + change[k].z > kNearest * from.z; }
    /// Least squares, in closed form. The weights 1 / w'^2 make pixels of homogeneous differences. Each
    /// coordinate is fitted by itself, so that the result does not depend on where the raster begins.
    std::optional<glm::dvec3> fit() const {
        glm::dvec3 sum(0);
        double weights = 0;
        for (std::size_t k = 0; k < N; ++k) {
            if (!counts(k)) continue;
            const double depth = from.z + change[k].z, weight = after[k] / (depth * depth);
            sum += weight * change[k];
            weights += weight * after[k];
        }
        if (!(weights > 0)) return std::nullopt;
        return sum / weights;
    }
    double missOf(const glm::dvec3& motion) const {
        double most = 0;
        for (std::size_t k = 0; k < N; ++k) {
            const glm::dvec3 line = from + after[k] * motion, truth = from + change[k];
            if (!counts(k) || !(line.z > kNearest * from.z)) continue;
            most = std::max(most, glm::length(glm::dvec2(line) / line.z - glm::dvec2(truth) / truth.z));
        }
        return most;
    }
};

} // namespace

SampleMotion::SampleMotion(const Camera& camera, const Geometry& geometry)
    : camera_(camera), geometry_(geometry), cameraMoves_(camera.moves()) {
    if (!any()) return;
    for (int i = -1; i < int(geometry.moverCount()); ++i) tables_.push_back(tableOf(i));
}

glm::dmat4x3 SampleMotion::pinholeFromBody(int mover, double time) const {
    const glm::dmat4x3 pinholeFromWorld = camera_.pinholeFromWorld(time);
    return mover < 0 ? pinholeFromWorld : pinholeFromWorld * geometry_.placement(mover).at(time);
}

SampleMotion::Table SampleMotion::tableOf(int mover) const {
    Table table;
    for (std::size_t k = 0; k < kTimes; ++k)
        table[k] = pinholeFromBody(mover, double(k) / double(kTimes - 1));
    return table;
}

FittedMotion SampleMotion::of(const SurfaceHit& hit, const Ray& ray) const {
    if (hit.mover < 0 && !cameraMoves_) return {};
    const double time = double(ray.time);
    // Where nothing was hit, a point at depth 1 in the same direction, of which the place of the eye is no
    // part.
    glm::dvec4 point = hit.hit() ? glm::dvec4(hit.position, 1) : glm::dvec4(ray.direction, 0);
    if (hit.mover >= 0) point = affineInverse(geometry_.placement(hit.mover).at(time)) * point;

    Path<kTimes> path;
    path.from = pinholeFromBody(hit.mover, time) * point;
    const Table& table = tables_[std::size_t(hit.mover + 1)];
    for (std::size_t k = 0; k < kTimes; ++k) {
        path.after[k] = double(k) / double(kTimes - 1) - time;
        path.change[k] = table[k] * point - path.from;
    }
    if (const auto motion = path.fit()) return {glm::vec3(*motion), float(path.missOf(*motion))};
    const double step = time < 0.5 ? kTangentStep : -kTangentStep;
    return {glm::vec3((pinholeFromBody(hit.mover, time + step) * point - path.from) / step), 0};
}

void MotionMisses::add(float missPx) {
    mostPx_ = std::max(mostPx_, missPx);
    const float place = missPx > kFirstPx ? std::ceil(4 * std::log2(missPx / kFirstPx)) : 0;
    ++counts_[std::size_t(std::min(place, float(kBins - 1)))];
}

void MotionMisses::add(const MotionMisses& other) {
    mostPx_ = std::max(mostPx_, other.mostPx_);
    for (std::size_t i = 0; i < kBins; ++i) counts_[i] += other.counts_[i];
}

float MotionMisses::quantilePx(double share) const {
    std::uint64_t all = 0, below = 0;
    for (const std::uint64_t count : counts_) all += count;
    for (std::size_t i = 0; i + 1 < kBins; ++i)
        if (below += counts_[i]; double(below) >= share * double(all))
            return std::min(mostPx_, kFirstPx * std::exp2(float(i) / 4));
    return mostPx_;
}

} // namespace slant

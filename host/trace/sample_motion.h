// How the points of samples move over the shutter, as the light field describes it: along straight lines in
// homogeneous coordinates (lightfield.h). Points that turn, and those seen by a turning camera, move along
// curves; their line is the one through where they are at the sample's own time that comes nearest to the
// curve over the whole shutter.
#pragma once
#include "camera/camera.h"
#include "trace/geometry.h"

#include <array>
#include <vector>

namespace slant {

/// A straight motion, and the most by which it misses the true one at any time, in pixels.
struct FittedMotion {
    glm::vec3 motion{0}; ///< SampleSet::motion
    float missPx = 0;
};

class SampleMotion {
public:
    /// Both must live longer.
    SampleMotion(const Camera& camera, const Geometry& geometry);

    /// Whether anything moves; what does not, has a motion of exactly 0.
    bool any() const { return cameraMoves_ || geometry_.moverCount() > 0; }
    /// Of what a camera ray met.
    FittedMotion of(const SurfaceHit& hit, const Ray& ray) const;

private:
    /// Times that the fit looks at, evenly over the shutter, both ends included.
    static constexpr std::size_t kTimes = 9;
    using Table = std::array<glm::dmat4x3, kTimes>;

    /// Homogeneous raster position of points of a mover (-1: of what keeps still).
    glm::dmat4x3 pinholeFromBody(int mover, double time) const;
    Table tableOf(int mover) const;

    const Camera& camera_;
    const Geometry& geometry_;
    bool cameraMoves_;
    std::vector<Table> tables_; ///< of what keeps still, then of each mover
};

/// The misses of many samples.
class MotionMisses {
public:
    void add(float missPx);
    void add(const MotionMisses& other);
    float mostPx() const { return mostPx_; }
    /// This share of all samples misses by no more, within a fifth of the value.
    float quantilePx(double share) const;

private:
    // Bin i counts misses up to kFirstPx 2^(i / 4), the last one all beyond.
    static constexpr std::size_t kBins = 80;
    std::array<std::uint64_t, kBins> counts_{};
    float mostPx_ = 0;
};

} // namespace slant

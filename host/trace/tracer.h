// Traces samples of the light field of a scene: camera, pattern, geometry and shading together.
#pragma once
#include "base/monitor.h"
#include "base/rect.h"
#include "camera/camera.h"
#include "lightfield/lightfield.h"
#include "scene/scene.h"
#include "trace/geometry.h"
#include "trace/path.h"
#include "trace/sample_motion.h"
#include "trace/sample_options.h"

#include <span>
#include <utility>

namespace slant {

/// Immutable once built; the scene must outlive it.
class Tracer {
public:
    /// Throws Error(badInput) for a scene that cannot be traced, Error(resources) when memory runs out.
    Tracer(const Scene& scene, Monitor& monitor, SlopeSource slopes = SlopeSource::optics);

    /// Writes samples of each pixel of `pixels`, of a pattern of samplesPerPixel, in the order of LightField:
    /// row, column, sample. Any pixels are allowed, on the film or beside it. A sample depends on its pixel,
    /// its index, samplesPerPixel and the seed alone. Calls monitor.advance with samples. `out` has room for
    /// all of them; `misses`, if not null, receives what straight motions miss, if `out` has room for motion.
    /// Throws Error(usage) for sizes that do not fit, and what the monitor throws.
    void trace(Rect pixels, const PixelSamples& samples, int samplesPerPixel, std::uint64_t seed,
               const SampleSpans& out, Monitor& monitor, MotionMisses* misses = nullptr) const;

    /// Whether anything moves while the shutter is open: if not, all motion is 0.
    bool moves() const { return motion_.any(); }

    /// The nearest and farthest depth seen from the middle of the lens, without outliers; either may be
    /// infinite.
    std::pair<double, double> depthRange() const;

    const Camera& camera() const { return camera_; }
    const Geometry& geometry() const { return geometry_; }

private:
    const Scene& scene_;
    Camera camera_;
    Geometry geometry_;
    Shading shading_;
    SampleMotion motion_;
    bool findsImages_; ///< samples show the depths of what is seen in mirrors and through glass
};

} // namespace slant

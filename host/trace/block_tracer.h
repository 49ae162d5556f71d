// Traces one small block of pixels, sample by sample: what Tracer does in parallel.
#pragma once
#include "camera/camera.h"
#include "trace/geometry.h"
#include "trace/path.h"
#include "trace/pattern.h"
#include "trace/sample_motion.h"
#include "trace/sample_options.h"

#include <array>
#include <span>

namespace slant {

/// Pixels of a block are traced together, all with the same sample index. Blocks lie on a fixed grid of the
/// raster and are traced whole, so that the rays traced together do not depend on the requested rectangle.
constexpr int kBlockSize = 4;

/// What one call of Tracer::trace works on (tracer.h).
struct TraceJob {
    const Scene& scene;
    const Camera& camera;
    const Geometry& geometry;
    const Shading& shading;
    const Pattern& pattern;
    Rect pixels;
    PixelSamples samples;
    SampleSpans out;
    const SampleMotion& motion;
    bool findsImages; ///< of mirrors and glass
    float farAway;    ///< where lights without a place are said to be
};

class BlockTracer {
public:
    /// The block of pixels from (x0, y0), multiples of kBlockSize.
    BlockTracer(const TraceJob& job, int x0, int y0);

    /// All samples of its pixels; returns how many.
    std::uint64_t trace();
    /// By how much straight motions missed, if the job asks for motion.
    const MotionMisses& misses() const { return misses_; }

private:
    static constexpr int kLanes = kBlockSize * kBlockSize;

    int x(int lane) const { return x0_ + lane % kBlockSize; }
    int y(int lane) const { return y0_ + lane / kBlockSize; }
    /// One sample of each pixel.
    void trace(int sample);
    void generate(int sample);
    void shade(int sample);
    void traceShadows(std::span<const Ray> rays, std::span<std::uint8_t> occluded);
    void finish(int lane);
    float depthOf(int lane) const;
    void store(int lane, int sample);
    void storeShadow(int lane, std::size_t index, float exposure);

    const TraceJob& job_;
    int x0_, y0_;
    std::array<PatternPixel, kLanes> places_;
    std::array<std::size_t, kLanes> starts_;  ///< where the samples of each pixel are written
    std::array<int, kLanes> ends_;            ///< one past its last sample; none are wanted of pixels outside
    std::array<float, kLanes> lastX_, lastY_; ///< largest raster positions inside the pixels
    std::array<LightFieldSample, kLanes> samples_;
    std::array<SurfaceGuides, kLanes> guides_;
    std::array<float, kLanes> weights_; ///< of the radiance
    std::array<Ray, kLanes> rays_;
    std::array<SurfaceHit, kLanes> hits_;
    std::array<ShadingSampler, kLanes> samplers_;
    std::array<PathState, kLanes> paths_;
    std::array<ShadowRay, kLanes> shadows_;
    std::array<float, kLanes> blockers_; ///< distances of what is in the way; infinity: nothing
    std::array<bool, kLanes> goesOn_;
    MotionMisses misses_;
};

} // namespace slant

#include "trace/tracer.h"

#include "base/error.h"
#include "base/parallel.h"
#include "trace/block_tracer.h"

#include <algorithm>
#include <cmath>
#include <mutex>

namespace slant {
namespace {

/// Blocks that one thread takes at a time.
constexpr std::size_t kBlocksAtOnce = 16;

int floorDivide(int a, int b) {
    return a >= 0 ? a / b : -((b - 1 - a) / b);
}

/// Rays per side of the film that look for the depths of a scene, and the share at either end that does not
/// count.
constexpr int kDepthProbes = 32;
constexpr double kOutlierShare = 0.02;

/// Lights without a place are said to be so many times as far away as the scene is large.
constexpr float kFarAway = 100;

float diagonalOf(const Box& box) {
    return box.empty() ? 1.f : glm::length(box.max - box.min);
}

} // namespace

Tracer::Tracer(const Scene& scene, Monitor& monitor, SlopeSource slopes)
    : scene_(scene), camera_(scene), geometry_(scene, monitor), shading_(scene), motion_(camera_, geometry_),
      findsImages_(slopes == SlopeSource::optics && camera_.slopeModel().c1 != 0) {}

std::pair<double, double> Tracer::depthRange() const {
    std::vector<float> depths;
    for (int i = 0; i < kDepthProbes * kDepthProbes; ++i) {
        const int column = i % kDepthProbes, row = i / kDepthProbes;
        const glm::vec2 part = (glm::vec2(column, row) + 0.5f) / float(kDepthProbes);
        // Every row and every column of probes sees all of the shutter.
        const float time = (float((column + row) % kDepthProbes) + 0.5f) / kDepthProbes;
        const glm::vec2 raster = part * glm::vec2(scene_.film.xResolution, scene_.film.yResolution);
        const CameraSample sample = camera_.visit([&](const auto& camera) {
            return camera.sample(raster, {0.5f, 0.5f}, time);
        });
        SurfaceHit hit;
        if (sample.weight > 0)
            geometry_.intersect(
                {sample.ray.origin, sample.ray.direction, std::numeric_limits<float>::infinity(), time}, hit);
        depths.push_back(hit.t);
    }
    std::sort(depths.begin(), depths.end());
    const std::size_t outliers = std::size_t(kOutlierShare * double(depths.size()));
    return {double(depths[outliers]), double(depths[depths.size() - 1 - outliers])};
}

namespace {

/// Throws Error(usage) unless they are of a pattern and `out` has room for them.
void checkRoom(Rect pixels, const PixelSamples& samples, int samplesPerPixel, const SampleSpans& out) {
    const bool startsFit = samples.starts.empty() || samples.starts.size() == pixels.area() + 1;
    const std::size_t count = startsFit ? samples.startOf(pixels.area()) : 0;
    const auto fits = [&](std::span<const glm::vec3> plane, bool optional) {
        return plane.size() == count || (optional && plane.empty());
    };
    int most = samples.count;
    for (std::size_t i = 1; i < samples.starts.size(); ++i) most = std::max(most, samples.countOf(i - 1));
    if (!startsFit || samples.first < 0 || samples.count < 0 || most > samplesPerPixel - samples.first ||
        out.samples.size() != count || !fits(out.radiance, false) || !fits(out.albedo, true) ||
        !fits(out.normal, out.albedo.empty()) || !fits(out.motion, true) || !fits(out.illumination, true) ||
        !fits(out.reflectance, out.illumination.empty()) || !fits(out.reflection, out.illumination.empty()) ||
        !fits(out.position, true) || !fits(out.light, out.position.empty()) ||
        !fits(out.blocker, out.position.empty()) || !fits(out.direct, out.position.empty()))
        throw Error(ErrorCode::usage, "the buffers do not fit the samples to trace");
}

} // namespace

void Tracer::trace(Rect pixels, const PixelSamples& samples, int samplesPerPixel, std::uint64_t seed,
                   const SampleSpans& out, Monitor& monitor, MotionMisses* misses) const {
    const Pattern pattern(samplesPerPixel, seed);
    checkRoom(pixels, samples, samplesPerPixel, out);
    if (out.samples.empty()) return;
    TraceJob job{scene_,
                 camera_,
                 geometry_,
                 shading_,
                 pattern,
                 pixels,
                 samples,
                 out,
                 motion_,
                 findsImages_,
                 kFarAway * diagonalOf(geometry_.bounds())};
    std::mutex mutex;
    const int column0 = floorDivide(pixels.x0, kBlockSize),
              column1 = floorDivide(pixels.x1 - 1, kBlockSize) + 1;
    const int row0 = floorDivide(pixels.y0, kBlockSize), row1 = floorDivide(pixels.y1 - 1, kBlockSize) + 1;
    const std::size_t columns = std::size_t(column1 - column0), rows = std::size_t(row1 - row0);
    parallelFor(0, columns * rows, kBlocksAtOnce, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const int x = (column0 + int(i % columns)) * kBlockSize,
                      y = (row0 + int(i / columns)) * kBlockSize;
            BlockTracer block(job, x, y);
            const std::uint64_t traced = block.trace();
            if (misses) {
                const std::lock_guard lock(mutex);
                misses->add(block.misses());
            }
            monitor.advance(traced);
        }
    });
}

} // namespace slant

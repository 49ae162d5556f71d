#include "trace/tracer.h"

#include "base/error.h"
#include "base/parallel.h"
#include "camera/disc.h"
#include "trace/pattern.h"

#include <array>
#include <cmath>

namespace slant {
namespace {

/// Samples are traced in packets: the pixels of one block, all with the same sample index. Blocks lie on a
/// fixed grid and are traced whole, so that the company a ray keeps does not depend on the rectangle asked
/// for.
constexpr int kBlockSize = 4, kLanes = kBlockSize * kBlockSize;

int floorDivide(int a, int b) {
    return a >= 0 ? a / b : -((b - 1 - a) / b);
}

/// x in [pixel, pixel + 1), also after rounding.
float rasterPosition(int pixel, float offset) {
    return std::min(float(pixel) + offset, std::nextafter(float(pixel + 1), -1e30f));
}

/// What one call of Tracer::trace works on.
struct Job {
    Rect pixels;
    int firstSample, count;
    const Pattern& pattern;
    std::span<LightFieldSample> out;
    std::span<AuxiliarySample> auxiliary;
};

class BlockTracer {
public:
    BlockTracer(const ThinLens& camera, const Geometry& geometry, const Scene& scene, const Job& job, int x0,
                int y0)
        : camera_(camera), geometry_(geometry), scene_(scene), job_(job), slopes_(camera.slopeModel()),
          x0_(x0), y0_(y0) {
        for (int lane = 0; lane < kLanes; ++lane)
            places_[std::size_t(lane)] = job.pattern.pixel(x(lane), y(lane));
    }

    void trace(int sample) {
        generate(sample);
        geometry_.intersect(rays_, hits_);
        for (int lane = 0; lane < kLanes; ++lane)
            if (job_.pixels.contains(x(lane), y(lane))) store(lane, sample);
    }

private:
    int x(int lane) const { return x0_ + lane % kBlockSize; }
    int y(int lane) const { return y0_ + lane / kBlockSize; }
    void generate(int sample);
    void store(int lane, int sample);

    const ThinLens& camera_;
    const Geometry& geometry_;
    const Scene& scene_;
    const Job& job_;
    SlopeModel slopes_;
    int x0_, y0_;
    std::array<PatternPixel, kLanes> places_;
    std::array<LightFieldSample, kLanes> samples_;
    std::array<Ray, kLanes> rays_;
    std::array<SurfaceHit, kLanes> hits_;
};

void BlockTracer::generate(int sample) {
    for (int lane = 0; lane < kLanes; ++lane) {
        PatternPoint point = job_.pattern.point(places_[std::size_t(lane)], sample);
        LightFieldSample& s = samples_[std::size_t(lane)];
        s.x = rasterPosition(x(lane), point.x);
        s.y = rasterPosition(y(lane), point.y);
        glm::vec2 lens = concentricDisc(point.a, point.b);
        s.u = lens.x;
        s.v = lens.y;
        s.t = point.t;
        CameraRay ray = camera_.ray({s.x, s.y}, lens);
        rays_[std::size_t(lane)] = {ray.origin, ray.direction, std::numeric_limits<float>::infinity(),
                                    point.t};
    }
}

void BlockTracer::store(int lane, int sample) {
    const SurfaceHit& hit = hits_[std::size_t(lane)];
    LightFieldSample s = samples_[std::size_t(lane)];
    s.w = hit.t;
    s.slope = slopes_(hit.t);
    s.alpha = hit.hit() ? 1.f : 0.f;
    glm::vec3 direction = rays_[std::size_t(lane)].direction;
    // Until lights and materials are there: a light at the eye.
    s.r = s.g = s.b = hit.hit() ? std::abs(glm::dot(hit.shadingNormal, glm::normalize(direction))) : 0.f;
    s.unused = 0;
    std::size_t pixel = std::size_t(y(lane) - job_.pixels.y0) * std::size_t(job_.pixels.width()) +
                        std::size_t(x(lane) - job_.pixels.x0);
    std::size_t index = pixel * std::size_t(job_.count) + std::size_t(sample - job_.firstSample);
    job_.out[index] = s;
    if (job_.auxiliary.empty()) return;
    glm::vec3 normal = glm::dot(hit.shadingNormal, direction) > 0 ? -hit.shadingNormal : hit.shadingNormal;
    job_.auxiliary[index] = {hit.hit() ? glm::vec3(1) : glm::vec3(0), normal};
}

} // namespace

Tracer::Tracer(const Scene& scene, Monitor& monitor)
    : scene_(scene), camera_(scene.camera, scene.film), geometry_(scene, monitor) {}

void Tracer::trace(Rect pixels, int firstSample, int count, int samplesPerPixel, std::uint64_t seed,
                   std::span<LightFieldSample> out, std::span<AuxiliarySample> auxiliary,
                   Monitor& monitor) const {
    Pattern pattern(samplesPerPixel, seed);
    if (firstSample < 0 || count < 0 || firstSample + count > samplesPerPixel ||
        out.size() != pixels.area() * std::size_t(count) ||
        (!auxiliary.empty() && auxiliary.size() != out.size()))
        throw Error(ErrorCode::usage, "the buffers do not fit the samples to trace");
    Job job{pixels, firstSample, count, pattern, out, auxiliary};
    int column0 = floorDivide(pixels.x0, kBlockSize), column1 = floorDivide(pixels.x1 - 1, kBlockSize) + 1;
    int row0 = floorDivide(pixels.y0, kBlockSize), row1 = floorDivide(pixels.y1 - 1, kBlockSize) + 1;
    if (pixels.empty()) return;
    std::size_t columns = std::size_t(column1 - column0);
    parallelFor(0, columns * std::size_t(row1 - row0), 16, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            int x = (column0 + int(i % columns)) * kBlockSize, y = (row0 + int(i / columns)) * kBlockSize;
            BlockTracer block(camera_, geometry_, scene_, job, x, y);
            for (int sample = firstSample; sample < firstSample + count; ++sample) block.trace(sample);
            Rect covered = Rect{x, y, x + kBlockSize, y + kBlockSize}.intersect(pixels);
            monitor.advance(covered.area() * std::uint64_t(count));
        }
    });
}

} // namespace slant

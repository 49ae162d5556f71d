#include "trace/block_tracer.h"

#include "trace/specular_chain.h"

#include <algorithm>
#include <cmath>

namespace slant {
namespace {

/// The largest number below pixel + 1: keeps raster positions in their pixel after rounding.
float lastOfPixel(int pixel) {
    return std::nextafter(float(pixel + 1), -std::numeric_limits<float>::infinity());
}

/// What the film's white balance makes of a radiance.
glm::vec3 balanced(const Film& film, glm::vec3 radiance) {
    if (film.whiteBalance == glm::mat3(1)) return radiance;
    return glm::max(film.whiteBalance * radiance, 0.f);
}

/// What pbrt's sensor and film multiply a radiance by: brightness, and samples no brighter than the film
/// allows.
float exposureOf(const Film& film, glm::vec3 radiance) {
    const float brightest = film.imagingRatio * std::max({radiance.r, radiance.g, radiance.b});
    if (film.maxComponentValue > 0 && brightest > film.maxComponentValue)
        return film.imagingRatio * (film.maxComponentValue / brightest);
    return film.imagingRatio;
}

/// Component by component; 0 where the divisor is.
glm::vec3 quotient(glm::vec3 a, glm::vec3 b) {
    const auto divide = [](float x, float y) { return y > 0 ? x / y : 0.f; };
    return {divide(a.x, b.x), divide(a.y, b.y), divide(a.z, b.z)};
}

/// Images in what keeps still are taken to keep still; in what moves, to move with it.
SurfaceHit seenAt(float depth, const SurfaceHit& hit, const Ray& ray) {
    if (depth == hit.t || hit.mover >= 0) return hit;
    SurfaceHit image;
    image.materialIndex = hit.materialIndex;
    image.position = ray.origin + depth * ray.direction;
    return image;
}

} // namespace

BlockTracer::BlockTracer(const TraceJob& job, int x0, int y0) : job_(job), x0_(x0), y0_(y0) {
    for (int i = 0; i < kLanes; ++i) {
        const std::size_t lane = std::size_t(i);
        places_[lane] = job.pattern.pixel(x(i), y(i));
        lastX_[lane] = lastOfPixel(x(i));
        lastY_[lane] = lastOfPixel(y(i));
        const Rect& pixels = job.pixels;
        starts_[lane] = 0;
        ends_[lane] = job.samples.first;
        if (!pixels.contains(x(i), y(i))) continue;
        const std::size_t pixel =
            std::size_t(y(i) - pixels.y0) * std::size_t(pixels.width()) + std::size_t(x(i) - pixels.x0);
        starts_[lane] = job.samples.startOf(pixel);
        ends_[lane] += job.samples.countOf(pixel);
    }
}

std::uint64_t BlockTracer::trace() {
    const int first = job_.samples.first, last = *std::ranges::max_element(ends_);
    for (int sample = first; sample < last; ++sample) trace(sample);
    std::uint64_t traced = 0;
    for (const int end : ends_) traced += std::uint64_t(end - first);
    return traced;
}

void BlockTracer::trace(int sample) {
    generate(sample);
    job_.geometry.intersect(rays_, hits_);
    shade(sample);
    for (int lane = 0; lane < kLanes; ++lane)
        if (sample < ends_[std::size_t(lane)]) {
            finish(lane);
            store(lane, sample);
        }
}

void BlockTracer::generate(int sample) {
    job_.camera.visit([&](const auto& camera) {
        for (int i = 0; i < kLanes; ++i) {
            const std::size_t lane = std::size_t(i);
            const PatternPoint point = job_.pattern.point(places_[lane], sample);
            LightFieldSample& s = samples_[lane];
            s.x = std::min(float(x(i)) + point.x, lastX_[lane]);
            s.y = std::min(float(y(i)) + point.y, lastY_[lane]);
            const CameraSample seen = camera.sample({s.x, s.y}, {point.a, point.b}, point.t);
            s.u = seen.lens.x;
            s.v = seen.lens.y;
            s.t = point.t;
            weights_[lane] = seen.weight;
            // Where the lens lets nothing through, the film is black and in focus.
            const bool isWanted = job_.samples.starts.empty() || sample < ends_[lane];
            const float tMax = seen.weight > 0 && isWanted ? std::numeric_limits<float>::infinity() : 0;
            rays_[lane] = {seen.ray.origin, seen.ray.direction, tMax, point.t};
        }
    });
}

/// The first vertex of each path, with its shadow ray.
void BlockTracer::shade(int sample) {
    std::array<Ray, kLanes> shadowRays;
    std::array<std::uint8_t, kLanes> occluded;
    for (int i = 0; i < kLanes; ++i) {
        std::size_t lane = std::size_t(i);
        samplers_[lane] = job_.pattern.shading(places_[lane], sample);
        paths_[lane] = startPath(rays_[lane]);
        goesOn_[lane] = scatter(job_.shading, hits_[lane], job_.scene.maxDepth, samplers_[lane], paths_[lane],
                                shadows_[lane], job_.out.normal.empty() ? nullptr : &guides_[lane]);
        shadowRays[lane] = shadows_[lane].ray;
        if (!shadows_[lane].needed()) shadowRays[lane].tMax = 0;
    }
    traceShadows(shadowRays, occluded);
    for (std::size_t lane = 0; lane < kLanes; ++lane)
        if (shadows_[lane].needed() && !occluded[lane]) paths_[lane].add(shadows_[lane]);
}

/// With the distances of what is in the way where the field wants to know them.
void BlockTracer::traceShadows(std::span<const Ray> rays, std::span<std::uint8_t> occluded) {
    if (job_.out.position.empty()) {
        job_.geometry.occluded(rays, occluded);
        return;
    }
    job_.geometry.distances(rays, blockers_);
    for (std::size_t i = 0; i < rays.size(); ++i) occluded[i] = !std::isinf(blockers_[i]);
}

/// The rest of a path.
void BlockTracer::finish(int i) {
    std::size_t lane = std::size_t(i);
    ShadowRay shadow;
    for (bool on = goesOn_[lane]; on;) {
        SurfaceHit hit;
        job_.geometry.intersect(paths_[lane].ray, hit);
        on = scatter(job_.shading, hit, job_.scene.maxDepth, samplers_[lane], paths_[lane], shadow);
        if (shadow.needed() && !job_.geometry.occluded(shadow.ray)) paths_[lane].add(shadow);
    }
}

/// At which the sample's points are seen.
float BlockTracer::depthOf(int i) const {
    const std::size_t lane = std::size_t(i);
    const SurfaceHit& hit = hits_[lane];
    if (!job_.findsImages || !hit.hit() || !job_.shading.materials.mayBeSpecular(hit)) return hit.t;
    return job_.camera.visit([&](const auto& camera) {
        const glm::dmat4 axes = camera.worldFromCamera().at(double(rays_[lane].time));
        const double radius = -double(camera.slopeModel().c1) / camera.pinholeFromCamera()[0].x;
        const LensAxes lens{glm::dvec3(axes[0]), -glm::dvec3(axes[1]), radius};
        return imageDepth(job_.geometry, job_.shading.materials, rays_[lane], hit, lens);
    });
}

void BlockTracer::store(int i, int sample) {
    std::size_t lane = std::size_t(i);
    const SurfaceHit& hit = hits_[lane];
    const float depth = depthOf(i);
    LightFieldSample s = samples_[lane];
    s.w = depth;
    s.slope = job_.camera.slopeModel()(depth);
    s.alpha = hit.hit() ? 1.f : 0.f;
    const std::size_t index = starts_[lane] + std::size_t(sample - job_.samples.first);
    job_.out.samples[index] = s;
    const PathState& path = paths_[lane];
    const Film& film = job_.scene.film;
    const glm::vec3 radiance = balanced(film, path.radiance);
    const float exposure = weights_[lane] * exposureOf(film, weights_[lane] * radiance);
    job_.out.radiance[index] = exposure * radiance;
    if (!job_.out.albedo.empty()) job_.out.albedo[index] = guides_[lane].albedo;
    if (!job_.out.normal.empty()) job_.out.normal[index] = guides_[lane].normal;
    if (!job_.out.illumination.empty()) {
        const glm::vec3 reflectance = guides_[lane].reflectance;
        job_.out.illumination[index] = exposure * quotient(balanced(film, path.diffuse), reflectance);
        job_.out.reflectance[index] = reflectance;
        job_.out.reflection[index] = exposure * balanced(film, path.reflection);
        if (!job_.out.position.empty()) storeShadow(i, index, exposure);
    }
    if (!job_.out.motion.empty()) {
        // The dark around a picture keeps still.
        const FittedMotion fitted = weights_[lane] > 0
                                        ? job_.motion.of(seenAt(depth, hit, rays_[lane]), rays_[lane])
                                        : FittedMotion();
        // Where depths don't matter, those of the motion are 1, and those of samples are not.
        job_.out.motion[index] =
            job_.camera.isParallel() && std::isfinite(depth) ? depth * fitted.motion : fitted.motion;
        misses_.add(fitted.missPx);
    }
}

/// The shadow ray of a first vertex.
void BlockTracer::storeShadow(int i, std::size_t index, float exposure) {
    const std::size_t lane = std::size_t(i);
    const glm::vec3 position = hits_[lane].position;
    const ShadowRay& shadow = shadows_[lane];
    glm::vec3 light = position, blocker = position, direct(0);
    if (shadow.needed()) {
        const float distance = std::isinf(shadow.ray.tMax) ? job_.farAway : shadow.ray.tMax;
        light += distance * shadow.ray.direction;
        blocker = std::isinf(blockers_[lane]) ? light : position + blockers_[lane] * shadow.ray.direction;
        direct = exposure * quotient(balanced(job_.scene.film, shadow.diffuseShare * shadow.contribution),
                                     guides_[lane].reflectance);
    }
    job_.out.position[index] = position;
    job_.out.light[index] = light;
    job_.out.blocker[index] = blocker;
    job_.out.direct[index] = direct;
}

} // namespace slant

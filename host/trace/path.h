// The path integrator: radiance along a ray with up to `maxDepth` scattering events, as pbrt-v4's "path"
// means it (maxdepth 1 = direct light; light seen directly or in a mirror always counts; mirror bounces
// count).
//
// It is written as one step per vertex, so that a caller can trace many paths at once:
//
//     startPath -> repeat: intersect state.ray, scatter, add shadow.contribution unless occluded; while
//     scatter is true
//
// tracePath does this for a single path. Geometry never appears here other than as hits.
//
// Strategies. Lights with bounded estimates (all but discs, cut spheres and bent patches) are only sampled as
// lights on diffuse surfaces and on the diffuse part of a smooth coat: one shadow ray is the whole of direct
// light there, and a ray that scattered so and meets such a light adds nothing. Everywhere else light
// sampling and scattering are combined by the power heuristic (Veach 1997, section 9.2). Both have the
// expectation that pbrt's two-ray estimate has.
#pragma once
#include "lightfield/lightfield.h"
#include "trace/lights.h"
#include "trace/materials.h"

namespace slant {

/// What shading needs of a scene, which must live longer.
struct Shading {
    explicit Shading(const Scene& scene) : materials(scene), lights(scene) {}
    Materials materials;
    Lights lights;
};

/// Light that arrives unless something is in the way.
struct ShadowRay {
    Ray ray;
    glm::vec3 contribution{0}; ///< to the path's radiance, unless the ray is occluded; 0: nothing to trace
    glm::vec3 diffuseShare{0}; ///< of it, see PathState

    bool needed() const { return contribution != glm::vec3(0); }
};

/// A path under way.
struct PathState {
    /// How the ray left its origin: this decides the weight of light that it meets.
    enum class Origin { camera, diffuse, glossy };

    Ray ray; ///< to be intersected next
    glm::vec3 radiance{0};
    // Of it: what the first vertex reflected by Bsdf::evaluateDiffuse, and what it reflected otherwise.
    glm::vec3 diffuse{0}, reflection{0};
    glm::vec3 throughput{1};
    glm::vec3 diffuseShare{0}; ///< how much of what is added to the radiance is diffuse
    int depth = 0;             ///< scattering events so far
    Origin origin = Origin::camera;
    Receiver receiver;     ///< the ray's origin, unless it is the camera
    float pdf = 0;         ///< of the ray's direction there
    float lightChance = 1; ///< there, of looking for light on the side of the ray's direction
    float etaScale = 1;    ///< of the throughput, what refractions owe to the indices alone, inverted

    void add(glm::vec3 light) { add(light, diffuseShare); }
    void add(const ShadowRay& shadow) { add(shadow.contribution, shadow.diffuseShare); }

private:
    void add(glm::vec3 light, glm::vec3 share) {
        radiance += light;
        if (depth == 0) return; // the first vertex emits it
        diffuse += share * light;
        reflection += (1.f - share) * light;
    }
};

inline PathState startPath(const Ray& cameraRay) {
    PathState state;
    state.ray = cameraRay;
    return state;
}

/// Adds what the ray met of light: `hit`, or the infinite lights where nothing was hit. `wo`: unit, against
/// the ray.
void addEmission(const Lights& lights, const SurfaceHit& hit, glm::vec3 wo, PathState& state);

/// Direct light at a vertex by sampling one light, on one side of the surface.
ShadowRay sampleDirectLight(const Lights& lights, const Bsdf& bsdf, const SurfaceHit& hit,
                            const PathState& state, float side, float choice, glm::vec2 u);

/// Whether a last vertex sends a ray just to see what light it meets.
bool bsdfRayNeeded(const Lights& lights, const Bsdf& bsdf);

/// Sends the path on from a vertex: sets its ray, throughput and origin. False if it ends here: the light is
/// absorbed, or a last vertex chose a direction that bsdfRayNeeded does not ask for.
bool continuePath(const Lights& lights, const Bsdf& bsdf, const SurfaceHit& hit, int maxDepth, float lobe,
                  glm::vec2 u, PathState& state);

/// What filters and compositors want of a first vertex.
struct SurfaceGuides {
    glm::vec3 albedo{0};      ///< in [0, 1]
    glm::vec3 reflectance{0}; ///< of its diffuse part
    glm::vec3 normal{0};      ///< world space, unit length, towards the camera; 0 where nothing was hit
};

/// One vertex: state.ray met `hit` (or nothing: !hit.hit()). Fills `shadow`; true if state.ray is to be
/// traced on. `guides`, if not null, receives what denoisers want of this vertex. Sampler: float next1D(),
/// glm::vec2 next2D(), uniform in [0, 1).
template <typename Sampler>
bool scatter(const Shading& shading, const SurfaceHit& hit, int maxDepth, Sampler& sampler, PathState& state,
             ShadowRay& shadow, SurfaceGuides* guides = nullptr) {
    shadow.contribution = glm::vec3(0);
    if (guides) *guides = {};
    glm::vec3 wo = -glm::normalize(state.ray.direction);
    addEmission(shading.lights, hit, wo, state);
    if (!hit.hit() || (state.depth == maxDepth && !guides)) return false;
    Bsdf bsdf = shading.materials.bsdf(hit, wo);
    if (guides) *guides = {bsdf.albedo(), bsdf.reflectance(), bsdf.normal()};
    if (state.depth++ == maxDepth) return false;

    if (bsdf.scatters() && shading.lights.canSample()) {
        float choice = shading.lights.needsChoice() ? sampler.next1D() : 0.f;
        float side = bsdf.transmits() ? sampler.next1D() : 0.f;
        shadow = sampleDirectLight(shading.lights, bsdf, hit, state, side, choice, sampler.next2D());
    }
    if (state.depth == maxDepth && !bsdfRayNeeded(shading.lights, bsdf)) return false;
    float lobe = bsdf.hasTwoLobes() ? sampler.next1D() : 0.f;
    if (!continuePath(shading.lights, bsdf, hit, maxDepth, lobe, sampler.next2D(), state)) return false;

    float brightest = maxComponent(state.throughput) * state.etaScale;
    if (brightest < 1 && state.depth > 1) { // Russian roulette, as in pbrt-v4
        if (sampler.next1D() >= brightest) return false;
        state.throughput /= brightest;
    }
    return true;
}

/// Radiance along a camera ray. Geometry: bool intersect(const Ray&, SurfaceHit&), bool occluded(const Ray&).
template <typename Geometry, typename Sampler>
glm::vec3 tracePath(const Geometry& geometry, const Shading& shading, const Ray& cameraRay, int maxDepth,
                    Sampler& sampler) {
    PathState state = startPath(cameraRay);
    ShadowRay shadow;
    for (bool on = true; on;) {
        SurfaceHit hit;
        geometry.intersect(state.ray, hit);
        on = scatter(shading, hit, maxDepth, sampler, state, shadow);
        if (shadow.needed() && !geometry.occluded(shadow.ray)) state.add(shadow);
    }
    return state.radiance;
}

} // namespace slant

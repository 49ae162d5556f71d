#include "trace/path.h"

namespace slant {
namespace {

/// Shadow rays end this part of their length before the light, so that they do not meet it (pbrt-v4's
/// ShadowEpsilon).
constexpr float kShadowEpsilon = 1e-4f;

float powerHeuristic(float pdf, float otherPdf) {
    if (std::isinf(pdf)) return 1;
    float a = pdf * pdf, b = otherPdf * otherPdf;
    return a > 0 ? a / (a + b) : 0;
}

/// How much of the light that a vertex takes from wi, not by a mirror, is of the path's diffuse part.
glm::vec3 diffuseShareOf(const Bsdf& bsdf, glm::vec3 wi, const PathState& state) {
    if (state.depth > 1) return state.diffuseShare;
    if (!bsdf.glossy()) return glm::vec3(1);
    const glm::vec3 all = bsdf.evaluate(wi), diffuse = bsdf.evaluateDiffuse(wi);
    const auto share = [](float part, float whole) { return whole > 0 ? part / whole : 0.f; };
    return {share(diffuse.x, all.x), share(diffuse.y, all.y), share(diffuse.z, all.z)};
}

/// Light is looked for on one side of a surface at a time: on the one that `normal` points to.
float sideChance(const Bsdf& bsdf, bool near) {
    if (!bsdf.transmits()) return 1;
    return near ? bsdf.nearChance() : 1 - bsdf.nearChance();
}

} // namespace

void addEmission(const Lights& lights, const SurfaceHit& hit, glm::vec3 wo, PathState& state) {
    if (hit.hit()) {
        glm::vec3 emitted = lights.emitted(hit, wo);
        if (emitted == glm::vec3(0)) return;
        float weight = 1;
        if (state.origin == PathState::Origin::diffuse && lights.complete(hit)) return;
        if (state.origin != PathState::Origin::camera)
            weight = powerHeuristic(state.pdf, state.lightChance * lights.pdf(state.receiver, hit, -wo));
        state.add(state.throughput * emitted * weight);
        return;
    }
    for (std::size_t i = 0; i < lights.infiniteCount(); ++i) {
        if (state.origin == PathState::Origin::diffuse && lights.infiniteBounded(i)) continue;
        float weight = 1;
        if (state.origin != PathState::Origin::camera)
            weight =
                powerHeuristic(state.pdf, state.lightChance * lights.infinitePdf(state.receiver, i, -wo));
        state.add(state.throughput * lights.infiniteRadiance(i, state.ray.origin, -wo) * weight);
    }
}

ShadowRay sampleDirectLight(const Lights& lights, const Bsdf& bsdf, const SurfaceHit& hit,
                            const PathState& state, float side, float choice, glm::vec2 u) {
    ShadowRay shadow;
    LightSample light;
    const bool near = !bsdf.transmits() || side < bsdf.nearChance();
    const Receiver receiver{hit.position, near ? bsdf.normal() : -bsdf.normal(), state.ray.time};
    if (!lights.sample(receiver, choice, u, light)) return shadow;
    light.pdf *= sideChance(bsdf, near);
    if (bsdf.transmits() && glm::dot(light.direction, receiver.normal) <= 0) return shadow;
    glm::vec3 value = bsdf.evaluate(light.direction);
    if (value == glm::vec3(0) || light.radiance == glm::vec3(0)) return shadow;
    float weight = 1;
    if (!light.delta && (!light.bounded || bsdf.glossy()))
        weight = powerHeuristic(light.pdf, bsdf.pdf(light.direction));
    shadow.contribution = state.throughput * value * light.radiance * (weight / light.pdf);
    shadow.diffuseShare = diffuseShareOf(bsdf, light.direction, state);
    shadow.ray = {offsetRayOrigin(hit.position, hit.positionError, hit.geometricNormal, light.direction),
                  light.direction, light.distance * (1 - kShadowEpsilon), state.ray.time};
    return shadow;
}

bool bsdfRayNeeded(const Lights& lights, const Bsdf& bsdf) {
    return lights.canBeSeen() && (bsdf.hasMirror() || bsdf.glossy() || !lights.complete());
}

bool continuePath(const Lights& lights, const Bsdf& bsdf, const SurfaceHit& hit, int maxDepth, float lobe,
                  glm::vec2 u, PathState& state) {
    BsdfSample next;
    if (!bsdf.sample(lobe, u, next) || next.weight == glm::vec3(0)) return false;
    if (state.depth == maxDepth && !next.specular && !bsdf.glossy() && lights.complete()) return false;
    state.origin = next.specular   ? PathState::Origin::camera
                   : bsdf.glossy() ? PathState::Origin::glossy
                                   : PathState::Origin::diffuse;
    if (!next.specular) state.diffuseShare = diffuseShareOf(bsdf, next.direction, state);
    state.throughput *= next.weight;
    state.etaScale *= next.eta * next.eta;
    const bool near = !bsdf.transmits() || glm::dot(next.direction, bsdf.normal()) > 0;
    state.receiver = {hit.position, near ? bsdf.normal() : -bsdf.normal(), state.ray.time};
    state.lightChance = sideChance(bsdf, near);
    state.pdf = next.pdf;
    state.ray = {offsetRayOrigin(hit.position, hit.positionError, hit.geometricNormal, next.direction),
                 next.direction, std::numeric_limits<float>::infinity(), state.ray.time};
    return true;
}

} // namespace slant

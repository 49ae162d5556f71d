// Gives a synthetic light field the parts of its radiance: its colours become reflectances, lit by light that
// is known but for its noise.
#pragma once
#include "lightfield/lightfield.h"
#include "support/synthetic.h"

#include <algorithm>

namespace slant::test {

struct Lit {
    std::function<float(glm::vec2 p)> light = [](glm::vec2) { return 1.f; }; ///< over pinhole position
    float noise = 1;      ///< radiance is (1 - noise) to (1 + noise) times that
    float reflection = 0; ///< the same light once more, not by the colour but by this
    std::uint32_t seed = 3;
    float shadow = 0; ///< height of an edge, as a share of that of the light: shadowShare; 0: no shadow rays
};

/// The edge is at x = 40 pixels and blocks what passes to the left of it; the light is as wide as this.
inline constexpr float kEdge = 40, kLightWidth = 30, kLightHeight = 50;

/// The share of the light that arrives at a pinhole position.
inline float shadowShare(float height, float x) {
    const float end = (kEdge - (1 - height) * x) / height; // place on the light of the line past the edge
    return std::clamp((kEdge + kLightWidth / 2 - end) / kLightWidth, 0.f, 1.f);
}

inline void castShadow(LightField& field, std::size_t i, float height, synthetic::Random& random) {
    const LightFieldSample& s = field.samples[i];
    const glm::vec3 from(glm::vec2(s.x, s.y) - s.slope * glm::vec2(s.u, s.v), 0);
    const glm::vec2 across = kLightWidth * (glm::vec2(random.uniform(), random.uniform()) - 0.5f);
    const glm::vec3 to(kEdge + across.x, from.y + across.y, -kLightHeight);
    const glm::vec3 passed = glm::mix(from, to, height);
    field.position[i] = from;
    field.light[i] = to;
    field.blocker[i] = passed.x < kEdge ? passed : to;
    field.direct[i] = field.illumination[i];
    if (passed.x < kEdge) field.illumination[i] = glm::vec3(0);
}

inline void lightUp(LightField& field, const Lit& lit) {
    synthetic::Random random(lit.seed);
    const std::size_t count = field.samples.size();
    field.resize(
        count,
        {.albedo = field.hasGuides(), .shading = true, .shadows = lit.shadow > 0, .motion = field.moves()});
    for (std::size_t i = 0; i < count; ++i) {
        const LightFieldSample& s = field.samples[i];
        const auto noisy = [&] { return 1 + lit.noise * (2 * random.uniform() - 1); };
        const float light = lit.light(glm::vec2(s.x, s.y) - s.slope * glm::vec2(s.u, s.v));
        const bool hit = !std::isinf(s.w);
        field.normal[i] = glm::vec3(0, 0, hit ? -1 : 0);
        field.reflectance[i] = hit ? field.radiance[i] : glm::vec3(0);
        field.illumination[i] = glm::vec3(hit ? light * noisy() : 0);
        if (lit.shadow > 0) castShadow(field, i, lit.shadow, random);
        field.reflection[i] = glm::vec3(hit ? lit.reflection * light * noisy() : 0);
        if (hit) field.radiance[i] = field.reflectance[i] * field.illumination[i] + field.reflection[i];
    }
}

} // namespace slant::test

// Gives a synthetic light field the parts of its radiance: its colours become reflectances, lit by light that
// is known but for its noise.
#pragma once
#include "lightfield/lightfield.h"
#include "support/synthetic.h"

namespace slant::test {

struct Lit {
    std::function<float(glm::vec2 p)> light = [](glm::vec2) { return 1.f; }; ///< over pinhole position
    float noise = 1;      ///< radiance is (1 - noise) to (1 + noise) times that
    float reflection = 0; ///< the same light once more, not by the colour but by this
    std::uint32_t seed = 3;
};

inline void lightUp(LightField& field, const Lit& lit) {
    synthetic::Random random(lit.seed);
    const std::size_t count = field.samples.size();
    field.resize(count, {.albedo = field.hasGuides(), .shading = true, .motion = field.moves()});
    for (std::size_t i = 0; i < count; ++i) {
        const LightFieldSample& s = field.samples[i];
        const auto noisy = [&] { return 1 + lit.noise * (2 * random.uniform() - 1); };
        const float light = lit.light(glm::vec2(s.x, s.y) - s.slope * glm::vec2(s.u, s.v));
        const bool hit = !std::isinf(s.w);
        field.normal[i] = glm::vec3(0, 0, hit ? -1 : 0);
        field.reflectance[i] = hit ? field.radiance[i] : glm::vec3(0);
        field.illumination[i] = glm::vec3(hit ? light * noisy() : 0);
        field.reflection[i] = glm::vec3(hit ? lit.reflection * light * noisy() : 0);
        if (hit) field.radiance[i] = field.reflectance[i] * field.illumination[i] + field.reflection[i];
    }
}

} // namespace slant::test

// Metals under a coat: closed forms where a layer is smooth or does nothing, and values against samples.
#include "shading_scene.h"

#include <gtest/gtest.h>

namespace slant {
namespace {

using test::average;
using test::Estimate;
using test::Random;

const glm::vec3 kEta(0.2f, 0.92f, 1.1f), kK(3.9f, 2.45f, 2.14f);

glm::vec3 direction(float degrees, float azimuth) {
    const float t = glm::radians(degrees), p = glm::radians(azimuth);
    return {std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), std::cos(t)};
}

Bsdf coated(glm::vec3 wo, float coat, float metal, const Layers& layers) {
    return Bsdf::coatedConductor({0, 0, 1}, {1, 0, 0}, wo, {glm::vec2(coat)}, layers, {glm::vec2(metal)},
                                 kEta / layers.eta, kK / layers.eta);
}

TEST(CoatedConductor, smoothLayersAreAMirrorWithASeries) {
    const Layers layers{1.5f, 0.1f, 10};
    const Bsdf b = coated(direction(40, 20), 0, 0, layers);
    EXPECT_TRUE(b.specular());
    BsdfSample s;
    ASSERT_TRUE(b.sample(0.5f, {0.5f, 0.5f}, s));
    EXPECT_LT(glm::distance(s.direction, direction(40, 200)), 1e-6f);
    float inside;
    const float f = fresnelDielectric(std::cos(glm::radians(40.f)), 1.5f, inside);
    for (int c = 0; c < 3; ++c) {
        const float once = std::exp(-0.2f / inside) * fresnelConductor(inside, kEta[c] / 1.5f, kK[c] / 1.5f);
        float sum = f;
        for (int n = 0; n < 5; ++n) sum += (1 - f) * (1 - f) * once * std::pow(f * once, float(n));
        EXPECT_NEAR(s.weight[c], sum, 1e-5f);
    }
}

TEST(CoatedConductor, aCoatOfIndexOneIsNotThere) {
    const Layers nothing{1, 0, 10};
    for (const float degrees : {10.f, 60.f}) {
        const glm::vec3 wo = direction(degrees, 30), wi = direction(35, 190);
        const Bsdf bare = Bsdf::conductor({0, 0, 1}, {1, 0, 0}, wo, {glm::vec2(0.3f)}, kEta, kK);
        const glm::vec3 there = coated(wo, 0, 0.3f, nothing).evaluate(wi), truth = bare.evaluate(wi);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(there[c], truth[c], 1e-4f * truth[c]);
        BsdfSample s, other;
        ASSERT_TRUE(coated(wo, 0, 0, nothing).sample(0.5f, {0.5f, 0.5f}, s));
        ASSERT_TRUE(
            Bsdf::conductor({0, 0, 1}, {1, 0, 0}, wo, {}, kEta, kK).sample(0.5f, {0.5f, 0.5f}, other));
        EXPECT_LT(glm::distance(s.weight, other.weight), 1e-5f);
    }
}

/// Values are estimates, and so are weights of samples: both have the same means.
TEST(CoatedConductor, valuesAndSamplesAgree) {
    struct Setting {
        float coat, metal;
    };
    const Layers layers{1.5f, 0.05f, 10};
    for (const Setting set : {Setting{0, 0.3f}, {0.3f, 0}, {0.2f, 0.4f}, {0.5f, 0.1f}})
        for (const float degrees : {10.f, 65.f}) {
            const Bsdf b = coated(direction(degrees, 70), set.coat, set.metal, layers);
            Random random;
            for (const auto score : std::initializer_list<double (*)(glm::vec3)>{
                     [](glm::vec3) { return 1.0; }, [](glm::vec3 w) { return double(w.x); },
                     [](glm::vec3 w) { return w.z < 0.5f ? 1.0 : 0.0; }}) {
                BsdfSample s;
                const Estimate sampled = average(60000, [&] {
                    const float lobe = random.next1D();
                    if (!b.sample(lobe, random.next2D(), s) || s.specular) return 0.0;
                    return double(s.weight.y) * score(s.direction);
                });
                const Estimate valued = average(60000, [&] {
                    const glm::vec3 wi = warpToCosineHemisphere(random.next2D());
                    return double(b.evaluate(wi).y / wi.z * kPi) * score(wi);
                });
                EXPECT_NEAR(sampled.mean, valued.mean, 4 * std::hypot(sampled.error, valued.error) + 1e-3)
                    << "coat " << set.coat << " metal " << set.metal << " at " << degrees;
            }
        }
}

TEST(CoatedConductor, losesEnergyOnlyAndReflectsAsMuchAsItSays) {
    // Nearer to the horizon light comes up from the metal near the critical angle, where its spread matters.
    for (const float degrees : {5.f, 50.f}) {
        const Layers layers{1.5f, 0.01f, 100};
        const Bsdf b = coated(direction(degrees, 10), 0, 0.02f, layers);
        Random random;
        BsdfSample s;
        const Estimate all = average(30000, [&] {
            const float lobe = random.next1D();
            return b.sample(lobe, random.next2D(), s) ? double(s.weight.y) : 0.0;
        });
        EXPECT_NEAR(all.mean, double(b.albedo().y), 4 * all.error + 5e-3) << degrees; // a nearly smooth metal
    }
}

} // namespace
} // namespace slant

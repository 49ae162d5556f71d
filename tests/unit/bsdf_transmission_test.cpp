// What passes surfaces: directions of Snell's law, energy, reciprocity, and that values, densities and
// samples agree on both sides.
#include "shading_scene.h"

#include <gtest/gtest.h>
#include <numbers>

namespace slant {
namespace {

using test::average;
using test::direction;
using test::Estimate;
using test::kNormal;
using test::kTangent;
using test::Random;
using test::toWorld;

/// Integral over the sphere of `value`, a function of a world direction.
template <typename Value>
double overSphere(const Value& value) {
    constexpr int kSteps = 400;
    double sum = 0;
    for (int i = 0; i < 2 * kSteps; ++i)
        for (int j = 0; j < kSteps; ++j) {
            const float z = (float(i) + 0.5f) / kSteps - 1, r = std::sqrt(1 - z * z),
                        phi = 2 * kPi * (float(j) + 0.5f) / kSteps;
            sum += double(value(toWorld({r * std::cos(phi), r * std::sin(phi), z})));
        }
    return sum * 4 * double(kPi) / (2 * kSteps * kSteps);
}

Bsdf glass(glm::vec3 wo, float alphaX, float alphaY, float eta) {
    return Bsdf::dielectric(kNormal, kTangent, wo, {{alphaX, alphaY}}, eta);
}

struct Case {
    const char* name;
    std::function<Bsdf(glm::vec3 wo)> make;
    float eta;
};

std::vector<Case> cases() {
    return {
        {"rough glass", [](glm::vec3 wo) { return glass(wo, 0.4f, 0.4f, 1.5f); }, 1.5f},
        {"anisotropic glass", [](glm::vec3 wo) { return glass(wo, 0.25f, 0.5f, 1.3f); }, 1.3f},
        {"leaf",
         [](glm::vec3 wo) {
             return Bsdf::diffuseTransmission(kNormal, wo, {0.3f, 0.5f, 0.1f}, {0.2f, 0.4f, 0.05f});
         },
         1},
    };
}

constexpr float kAngles[] = {5, 50, 80, 110, 165};

TEST(BsdfTransmission, densitiesIntegrateToOneAndSamplesFollowThem) {
    for (const Case& c : cases())
        for (const float degrees : kAngles) {
            SCOPED_TRACE(std::string(c.name) + " at " + std::to_string(degrees));
            const Bsdf b = c.make(direction(degrees, 70));
            const double mass = overSphere([&](glm::vec3 wi) { return b.pdf(wi); });
            Random random;
            BsdfSample s;
            const auto sampled = [&](auto value) {
                return average(20000, [&] {
                    const float lobe = random.next1D();
                    return b.sample(lobe, random.next2D(), s) ? double(value()) : 0.0;
                });
            };
            const Estimate kept = sampled([] { return 1; });
            EXPECT_NEAR(kept.mean, mass, 4 * kept.error + 4e-3);
            for (int axis = 0; axis < 3; ++axis) {
                const double moment = overSphere([&](glm::vec3 wi) { return b.pdf(wi) * wi[axis]; });
                const Estimate m = sampled([&] { return s.direction[axis]; });
                EXPECT_NEAR(m.mean, moment, 4 * m.error + 4e-3);
            }
            for (int i = 0; i < 200; ++i) {
                if (!b.sample(random.next1D(), random.next2D(), s)) continue;
                EXPECT_NEAR(s.pdf, b.pdf(s.direction), 3e-3f * s.pdf);
                EXPECT_NEAR(s.weight.y * s.pdf, b.evaluate(s.direction).y, 5e-3f * s.weight.y * s.pdf);
            }
        }
}

/// Radiance over the square of the index is what is kept.
TEST(BsdfTransmission, isReciprocal) {
    Random random;
    for (const Case& c : cases())
        for (int i = 0; i < 300; ++i) {
            glm::vec3 a = warpToSphere(random.next2D()), b = warpToSphere(random.next2D());
            if (std::min(std::abs(a.z), std::abs(b.z)) < 0.02f) continue;
            const auto index2 = [&](glm::vec3 w) { return w.z > 0 ? 1 : c.eta * c.eta; };
            const float there = c.make(toWorld(a)).evaluate(toWorld(b)).y / std::abs(b.z) * index2(b);
            const float back = c.make(toWorld(b)).evaluate(toWorld(a)).y / std::abs(a.z) * index2(a);
            ASSERT_NEAR(there, back, 3e-3f * there + 1e-5f) << c.name;
        }
}

TEST(BsdfTransmission, keepsEnergyWhereFacetsAreFlat) {
    // Left over by facets that are met once: measured 0.003 at most, steeply rising with alpha and the angle.
    for (const float degrees : {0.f, 40.f, 70.f, 120.f, 150.f, 180.f}) {
        const Bsdf b = glass(direction(degrees, 20), 0.02f, 0.02f, 1.5f);
        Random random;
        BsdfSample s;
        const Estimate energy = average(20000, [&] {
            const float lobe = random.next1D();
            return b.sample(lobe, random.next2D(), s) ? double(s.weight.x * s.eta * s.eta) : 0.0;
        });
        EXPECT_NEAR(energy.mean, 1, 5e-3 + 3 * energy.error) << degrees;
    }
}

/// What Walter, Marschner, Li and Torrance 2007 ("Microfacet Models for Refraction through Rough Surfaces",
/// equations 16, 20, 21) say of facets of Trowbridge and Reitz that light meets once, with Smith's masking
/// and shadowing of one height; in double precision. z is the normal, `wo` above it, eta behind over before.
struct PublishedGlass {
    double alpha, eta;

    double density(glm::dvec3 m) const {
        const double c2 = m.z * m.z, t = (1 - c2) / (c2 * alpha * alpha);
        return 1 / (std::numbers::pi * alpha * alpha * c2 * c2 * (1 + t) * (1 + t));
    }
    double seen(glm::dvec3 a, glm::dvec3 b) const {
        const auto lambda = [&](glm::dvec3 w) {
            return (std::sqrt(1 + alpha * alpha * (1 - w.z * w.z) / (w.z * w.z)) - 1) / 2;
        };
        return 1 / (1 + lambda(a) + lambda(b));
    }
    double reflectance(double cosine) const {
        const double g2 = eta * eta - 1 + cosine * cosine;
        if (g2 <= 0) return 1;
        const double g = std::sqrt(g2), a = (g - cosine) / (g + cosine);
        const double b = (cosine * (g + cosine) - 1) / (cosine * (g - cosine) + 1);
        return a * a * (1 + b * b) / 2;
    }
    /// Share of the light along wo that leaves after one facet, by the sum over facets.
    double energy(glm::dvec3 wo) const {
        constexpr int kSteps = 1500;
        double sum = 0;
        for (int i = 0; i < kSteps; ++i)
            for (int j = 0; j < kSteps; ++j) {
                const double z = (i + 0.5) / kSteps, phi = 2 * std::numbers::pi * (j + 0.5) / kSteps;
                const double r = std::sqrt(1 - z * z);
                const glm::dvec3 m(r * std::cos(phi), r * std::sin(phi), z);
                const double cosine = glm::dot(wo, m);
                if (cosine <= 0) continue;
                const double f = reflectance(cosine);
                const glm::dvec3 mirrored = 2 * cosine * m - wo;
                double leaves = mirrored.z > 0 ? f * seen(wo, mirrored) : 0;
                if (f < 1) {
                    const glm::dvec3 bent = glm::refract(-wo, m, 1 / eta);
                    if (bent.z < 0) leaves += (1 - f) * seen(wo, bent);
                }
                sum += leaves * density(m) * cosine / wo.z;
            }
        return sum * 2 * std::numbers::pi / (double(kSteps) * kSteps);
    }
};

/// Rough glass loses the light that meets more than one facet, in pbrt-v4 as here: neither less nor more.
TEST(BsdfTransmission, roughGlassLosesWhatItsDefinitionLoses) {
    for (const float alpha : {0.2f, std::sqrt(0.3f)})
        for (const float degrees : {10.f, 60.f, 130.f, 170.f}) {
            SCOPED_TRACE(std::to_string(alpha) + " at " + std::to_string(degrees));
            const double t = glm::radians(double(degrees));
            const PublishedGlass published{double(alpha), degrees < 90 ? 1.5 : 1 / 1.5};
            const double expected = published.energy({std::sin(t), 0, std::abs(std::cos(t))});
            const Bsdf b = glass(direction(degrees, 20), alpha, alpha, 1.5f);
            Random random;
            BsdfSample s;
            const Estimate sampled = average(40000, [&] {
                const float lobe = random.next1D();
                return b.sample(lobe, random.next2D(), s) ? double(s.weight.x * s.eta * s.eta) : 0.0;
            });
            EXPECT_NEAR(sampled.mean, expected, 4 * sampled.error + 1e-3);
            const double integrated = overSphere([&](glm::vec3 wi) {
                const bool crosses = glm::dot(wi, kNormal) * std::cos(t) < 0;
                return double(b.evaluate(wi).x) * (crosses ? published.eta * published.eta : 1);
            });
            EXPECT_NEAR(integrated, expected, 4e-3);
        }
}

TEST(BsdfTransmission, glassBendsLightBySnellAndFresnel) {
    for (const bool inside : {false, true}) {
        const glm::vec3 wo = direction(inside ? 150.f : 30.f, 40);
        const Bsdf b = glass(wo, 0, 0, 1.5f);
        EXPECT_TRUE(b.specular());
        EXPECT_FALSE(b.scatters());
        BsdfSample s;
        ASSERT_TRUE(b.sample(0.99f, {0.5f, 0.5f}, s));
        EXPECT_TRUE(s.specular);
        const float ratio = inside ? 1 / 1.5f : 1.5f;
        EXPECT_FLOAT_EQ(s.eta, ratio);
        EXPECT_NEAR(glm::length(glm::cross(s.direction, kNormal)), 0.5f / ratio, 1e-5f);
        EXPECT_NEAR(glm::dot(glm::cross(wo, kNormal), s.direction), 0, 1e-6f); // in one plane
        EXPECT_LT(glm::dot(s.direction, kNormal) * glm::dot(wo, kNormal), 0);
        EXPECT_NEAR(s.weight.x, 1 / (ratio * ratio), 1e-6f);
        int reflected = 0;
        for (int i = 0; i < 1000; ++i)
            reflected += b.sample((float(i) + 0.5f) / 1000, {0.5f, 0.5f}, s) && s.eta == 1;
        float unused;
        EXPECT_NEAR(float(reflected) / 1000, fresnelDielectric(std::cos(glm::radians(30.f)), ratio, unused),
                    1e-3f);
    }
    const Bsdf total = glass(direction(120, 0), 0, 0, 1.5f); // from within, beyond the critical angle
    BsdfSample s;
    ASSERT_TRUE(total.sample(0.999f, {0, 0}, s));
    EXPECT_EQ(s.eta, 1);
}

TEST(BsdfTransmission, panesLetLightStraightOn) {
    const glm::vec3 wo = direction(60, 10);
    const Bsdf pane = Bsdf::thinDielectric(kNormal, wo, 1.5f);
    BsdfSample s;
    ASSERT_TRUE(pane.sample(0.9f, {0, 0}, s));
    EXPECT_LT(glm::distance(s.direction, -wo), 1e-6f);
    EXPECT_EQ(s.weight, glm::vec3(1));
    // R + T R T + ...: 2 R / (1 + R) with R = 0.0892 at 60 degrees.
    ASSERT_TRUE(pane.sample(0.1637f, {0, 0}, s));
    EXPECT_GT(glm::dot(s.direction, kNormal), 0);
    ASSERT_TRUE(pane.sample(0.1640f, {0, 0}, s));
    EXPECT_LT(glm::dot(s.direction, kNormal), 0);
}

TEST(BsdfTransmission, glassWithoutAnIndexIsNotThere) {
    const glm::vec3 wo = direction(35, 10);
    BsdfSample s;
    for (const float lobe : {0.f, 0.5f, 0.99f}) {
        ASSERT_TRUE(glass(wo, 0.3f, 0.3f, 1).sample(lobe, {0.2f, 0.7f}, s));
        EXPECT_LT(glm::distance(s.direction, -wo), 1e-6f);
        EXPECT_EQ(s.weight, glm::vec3(1));
    }
}

} // namespace
} // namespace slant

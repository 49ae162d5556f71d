// Scattering: energy, reciprocity, and that values, densities and samples agree. The coated diffuse material
// is compared with a random walk through its layers that shares no formula with its expectation.
#include "shading_scene.h"

#include <gtest/gtest.h>

namespace slant {
namespace {

using test::average;
using test::direction;
using test::Estimate;
using test::kNormal;
using test::kTangent;
using test::Random;
using test::toWorld;

/// Integral over the hemisphere of `value`, a function of a world direction.
template <typename Value>
double overHemisphere(const Value& value) {
    constexpr int kSteps = 300;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i)
        for (int j = 0; j < kSteps; ++j) {
            float z = (float(i) + 0.5f) / kSteps, r = std::sqrt(1 - z * z),
                  phi = 2 * kPi * (float(j) + 0.5f) / kSteps;
            sum += double(value(toWorld({r * std::cos(phi), r * std::sin(phi), z})));
        }
    return sum * 2 * double(kPi) / (kSteps * kSteps);
}

struct Case {
    const char* name;
    std::function<Bsdf(glm::vec3 wo)> make;
};

const Coat& smoothCoat() {
    static const Coat coat(1.5f, 0.01f, 10, 0, 0);
    return coat;
}
const Coat& roughCoat() {
    static const Coat coat(1.5f, 0.01f, 10, 0.3f, 0.3f);
    return coat;
}
const Coat& variedCoat() {
    static const Coat coat(1.4f, 0.2f, 10, 0.2f, 0.5f);
    return coat;
}

std::vector<Case> cases() {
    const glm::vec3 eta(0.2f, 0.92f, 1.1f), k(3.9f, 2.45f, 2.14f), red(0.8f, 0.4f, 0.1f);
    return {
        {"diffuse", [=](glm::vec3 wo) { return Bsdf::diffuse(kNormal, wo, red); }},
        {"conductor",
         [=](glm::vec3 wo) {
             return Bsdf::conductor(kNormal, kTangent, wo, {{0.3f, 0.3f}}, eta, k);
         }},
        {"anisotropic conductor",
         [=](glm::vec3 wo) {
             return Bsdf::conductor(-kNormal, kTangent, wo, {{0.15f, 0.5f}}, eta, k);
         }},
        {"smooth coat",
         [=](glm::vec3 wo) {
             return Bsdf::coatedDiffuse(kNormal, kTangent, wo, {{0, 0}}, smoothCoat(), red);
         }},
        {"rough coat",
         [=](glm::vec3 wo) {
             return Bsdf::coatedDiffuse(kNormal, kTangent, wo, {{0.3f, 0.3f}}, roughCoat(), red);
         }},
        {"anisotropic coat",
         [=](glm::vec3 wo) {
             return Bsdf::coatedDiffuse(kNormal, kTangent, wo, {{0.2f, 0.5f}}, variedCoat(), red);
         }},
    };
}

TEST(Bsdf, diffuseReflectsItsReflectance) {
    Bsdf b = Bsdf::diffuse(kNormal, direction(50, 20), {1, 0.5f, 0.25f});
    EXPECT_NEAR(overHemisphere([&](glm::vec3 wi) { return b.evaluate(wi).x; }), 1, 1e-5);
    EXPECT_NEAR(overHemisphere([&](glm::vec3 wi) { return b.evaluate(wi).y; }), 0.5, 1e-5);
    EXPECT_EQ(b.albedo(), glm::vec3(1, 0.5f, 0.25f));
    EXPECT_EQ(b.evaluate(-kNormal), glm::vec3(0));
}

TEST(Bsdf, bothSidesScatterAlike) {
    for (const Case& c : cases()) {
        glm::vec3 local(0.4f, -0.3f, 0.5f), in(-0.2f, 0.6f, 0.7f);
        local = glm::normalize(local);
        in = glm::normalize(in);
        glm::vec3 mirrored(local.x, local.y, -local.z), inMirrored(in.x, in.y, -in.z);
        glm::vec3 a = c.make(toWorld(local)).evaluate(toWorld(in));
        glm::vec3 b = c.make(toWorld(mirrored)).evaluate(toWorld(inMirrored));
        for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], 1e-4f * a[i]) << c.name;
        EXPECT_EQ(c.make(toWorld(mirrored)).evaluate(toWorld(in)), glm::vec3(0)) << c.name;
    }
}

TEST(Bsdf, isReciprocal) {
    Random random;
    for (const Case& c : cases())
        for (int i = 0; i < 100; ++i) {
            glm::vec3 a = warpToCosineHemisphere(random.next2D()),
                      b = warpToCosineHemisphere(random.next2D());
            if (std::min(a.z, b.z) < 0.02f) continue;
            glm::vec3 there = c.make(toWorld(a)).evaluate(toWorld(b)) / b.z;
            glm::vec3 back = c.make(toWorld(b)).evaluate(toWorld(a)) / a.z;
            for (int j = 0; j < 3; ++j) ASSERT_NEAR(there[j], back[j], 2e-3f * there[j] + 1e-6f) << c.name;
        }
}

TEST(Bsdf, densitiesIntegrateToOneAndSamplesFollowThem) {
    for (const Case& c : cases())
        for (float degrees : {5.f, 45.f, 75.f}) {
            SCOPED_TRACE(std::string(c.name) + " at " + std::to_string(degrees));
            glm::vec3 wo = direction(degrees, 70);
            Bsdf b = c.make(wo);
            // What is neither lost below the horizon nor mirrored, and its mean direction.
            double mass = overHemisphere([&](glm::vec3 wi) { return b.pdf(wi); });
            glm::dvec3 moment;
            for (int axis = 0; axis < 3; ++axis)
                moment[axis] = overHemisphere([&](glm::vec3 wi) { return b.pdf(wi) * wi[axis]; });
            Random random;
            BsdfSample s;
            auto sampled = [&](auto value) {
                return average(20000, [&] {
                    float lobe = random.next1D();
                    if (!b.sample(lobe, random.next2D(), s)) return 0.0;
                    return double(value());
                });
            };
            Estimate kept = sampled([&] { return s.specular ? 0 : 1; });
            EXPECT_NEAR(kept.mean, mass, 4 * kept.error + 2e-3);
            EXPECT_LE(mass, 1 + 2e-3);
            if (!b.hasMirror() && !b.glossy()) {
                EXPECT_NEAR(mass, 1, 1e-4);
            }
            for (int axis = 0; axis < 3; ++axis) {
                Estimate m = sampled([&] { return s.specular ? 0 : s.direction[axis]; });
                EXPECT_NEAR(m.mean, moment[axis], 4 * m.error + 2e-3);
            }
            for (int i = 0; i < 200; ++i)
                if (b.sample(random.next1D(), random.next2D(), s) && !s.specular) {
                    EXPECT_NEAR(s.pdf, b.pdf(s.direction), 2e-3f * s.pdf);
                    EXPECT_NEAR(s.weight.y * s.pdf, b.evaluate(s.direction).y, 3e-3f * s.weight.y * s.pdf);
                }
        }
}

TEST(Bsdf, losesEnergyOnly) {
    for (const Case& c : cases())
        for (float degrees : {0.f, 30.f, 60.f, 80.f, 89.f}) {
            Bsdf b = c.make(direction(degrees, 200));
            Random random;
            BsdfSample s;
            Estimate e = average(20000, [&] {
                float lobe = random.next1D();
                return b.sample(lobe, random.next2D(), s) ? double(maxComponent(s.weight)) : 0.0;
            });
            EXPECT_LE(e.mean, 1 + 3 * e.error) << c.name << " at " << degrees;
            EXPECT_GT(e.mean, 0.02) << c.name;
            glm::vec3 albedo = b.albedo();
            EXPECT_TRUE(maxComponent(albedo) <= 1 && albedo.z >= 0) << c.name;
        }
}

TEST(Bsdf, mirrorReflectsByFresnel) {
    glm::vec3 wo = direction(60, 30);
    Bsdf b = Bsdf::conductor(kNormal, kTangent, wo, {{1e-4f, 5e-4f}}, glm::vec3(1.5f), glm::vec3(0));
    BsdfSample s;
    ASSERT_TRUE(b.sample(0.3f, {0.1f, 0.2f}, s));
    EXPECT_TRUE(s.specular);
    EXPECT_NEAR(glm::distance(s.direction, direction(60, 210)), 0, 1e-5f);
    EXPECT_NEAR(s.weight.x, 0.0892f, 1e-4f); // Fresnel of n = 1.5 at 60 degrees
    EXPECT_FALSE(b.scatters());
    EXPECT_EQ(b.pdf(s.direction), 0);
    // Silver in the red, normal incidence: ((n-1)^2 + k^2) / ((n+1)^2 + k^2).
    float n = 0.16f, k = 3.3f;
    EXPECT_NEAR(fresnelConductor(1, n, k), ((n - 1) * (n - 1) + k * k) / ((n + 1) * (n + 1) + k * k), 1e-5f);
}

// ------------------------------------------------------------------ coated diffuse against a random walk

/// pbrt's material as a plain random walk in the local frame: light enters from `wo`, and what leaves is
/// scored by `score(direction)` times its weight. `reflectance` is of one channel.
class LayerWalk {
public:
    double eta, thickness, reflectance;
    int maxDepth;
    float alpha;

    double sample(Random& random, glm::vec3 wo, const std::function<double(glm::vec3)>& score) const {
        glm::vec3 w = wo; // points away from the interface, on the side it is met from
        bool outside = true;
        double weight = 1;
        for (int depth = -1; depth < maxDepth; ++depth) {
            if (depth >= 0 && depth % 2 == 0) { // the base
                weight *= reflectance * std::exp(-thickness / double(std::abs(w.z)));
                w = warpToCosineHemisphere(random.next2D());
                continue;
            }
            if (depth >= 0) { // from the base up to the interface; seen from below
                weight *= std::exp(-thickness / double(w.z));
                w = {-w.x, -w.y, w.z}; // flips z: the local frame's normal now points inwards
                outside = false;
            }
            double index = outside ? eta : 1 / eta;
            Microfacets facets{glm::vec2(alpha)};
            glm::vec3 m = facets.smooth() ? glm::vec3(0, 0, 1) : facets.sampleVisible(w, random.next2D());
            double c = double(glm::dot(w, m)), sin2 = (1 - c * c) / (index * index);
            if (c <= 0) return 0;
            double ct = std::sqrt(std::max(0.0, 1 - sin2)), fresnel = 1;
            if (sin2 < 1) {
                double s = (c - index * ct) / (c + index * ct), p = (index * c - ct) / (index * c + ct);
                fresnel = (s * s + p * p) / 2;
            }
            bool reflects = double(random.next1D()) < fresnel;
            glm::vec3 out =
                reflects ? 2 * float(c) * m - w : (float(c / index) - float(ct)) * m - w / float(index);
            if (reflects ? out.z <= 0 : out.z >= 0) return 0;
            if (!facets.smooth()) weight *= double(facets.maskingShadowing(w, out) / facets.masking(w));
            if (outside && reflects) return weight * score(out);
            if (!outside && !reflects) return weight * score({out.x, out.y, -out.z});
            w = out;
        }
        return 0;
    }
};

TEST(CoatedDiffuse, isWhatARandomWalkGives) {
    struct Setting {
        float alpha, thickness;
        double reflectance, tolerance;
    };
    for (Setting set : {Setting{0, 0.01f, 0.9, 1e-3},
                        {0, 0.3f, 0.5, 1e-3},
                        {0.1f, 0.01f, 0.8, 2e-3},
                        {0.5f, 0.05f, 1, 3e-3}})
        for (float degrees : {10.f, 70.f}) {
            Coat coat(1.5f, set.thickness, 10, set.alpha, set.alpha);
            LayerWalk walk{1.5, double(set.thickness), set.reflectance, 10, set.alpha};
            float t = glm::radians(degrees);
            glm::vec3 wo(std::sin(t), 0, std::cos(t));
            Bsdf b = Bsdf::coatedDiffuse({0, 0, 1}, {1, 0, 0}, wo, {glm::vec2(set.alpha)}, coat,
                                         glm::vec3(float(set.reflectance)));
            for (auto score : std::initializer_list<double (*)(glm::vec3)>{
                     [](glm::vec3) { return 1.0; }, [](glm::vec3 w) { return double(w.z); },
                     [](glm::vec3 w) { return w.x > 0 ? 1.0 : 0.0; },
                     [](glm::vec3 w) { return w.z < 0.3f ? 1.0 : 0.0; }}) {
                Random a(3), c(5);
                Estimate truth = average(80000, [&] { return walk.sample(a, wo, score); });
                BsdfSample s;
                Estimate ours = average(40000, [&] {
                    float lobe = c.next1D();
                    return b.sample(lobe, c.next2D(), s) ? double(s.weight.x) * score(s.direction) : 0.0;
                });
                EXPECT_NEAR(ours.mean, truth.mean, 4 * (ours.error + truth.error) + set.tolerance)
                    << "alpha " << set.alpha << " thickness " << set.thickness << " at " << degrees;
            }
        }
}

TEST(CoatedDiffuse, theWalkIsCutWherePbrtCutsIt) {
    auto brightness = [](int maxDepth) {
        Coat coat(1.5f, 0, maxDepth, 0, 0);
        return coat.baseFactor(glm::vec3(1), 0).x;
    };
    EXPECT_EQ(brightness(0), 0);
    EXPECT_EQ(brightness(9), brightness(10));
    EXPECT_NEAR(brightness(10) / brightness(400), 1 - std::pow(0.5964, 5),
                2e-3); // internal albedo of n = 1.5
}

} // namespace
} // namespace slant

// Environment images: the equal-area map, and densities of sampling.
#include "shading_scene.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

namespace slant {
namespace {

using test::average;
using test::Estimate;
using test::Random;

TEST(Octahedral, mapsBackAndKeepsAreas) {
    Random random;
    for (int i = 0; i < 10000; ++i) {
        glm::vec2 p = random.next2D();
        glm::vec3 d = equalAreaSquareToSphere(p);
        ASSERT_NEAR(glm::length(d), 1, 1e-5f);
        glm::vec2 q = equalAreaSphereToSquare(d);
        ASSERT_NEAR(glm::distance(p, q), 0, 2e-4f) << p.x << " " << p.y;
    }
    EXPECT_NEAR(glm::distance(equalAreaSquareToSphere({0.5f, 0.5f}), glm::vec3(0, 0, 1)), 0, 1e-6f);
    EXPECT_NEAR(glm::distance(equalAreaSquareToSphere({0, 0}), glm::vec3(0, 0, -1)), 0, 1e-6f);
    EXPECT_NEAR(glm::distance(equalAreaSquareToSphere({1, 0.5f}), glm::vec3(1, 0, 0)), 0, 1e-6f);
    EXPECT_NEAR(glm::distance(equalAreaSquareToSphere({0.5f, 1}), glm::vec3(0, 1, 0)), 0, 1e-6f);
    // Equal areas: the share of random points in a cap is the cap's share of the sphere.
    glm::vec3 axis = glm::normalize(glm::vec3(1, 2, -0.7f));
    Estimate e = average(
        200000, [&] { return glm::dot(equalAreaSquareToSphere(random.next2D()), axis) > 0.6f ? 1.0 : 0.0; });
    EXPECT_NEAR(e.mean, 0.2, 4 * e.error);
}

Image sky(int size) {
    Image image = Image::rgb(size, size);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
            for (int c = 0; c < 3; ++c) image.at(x, y, c) = 0.2f + 0.1f * float((x * 7 + y * 3 + c) % 5);
    image.at(size / 2 + 1, size / 2 - 1, 1) = 900; // a sun
    image.at(1, 1, 0) = -5;                        // counts as 0
    return image;
}

TEST(Environment, samplesFollowTheirDensityAndGiveTheIrradiance) {
    Image image = sky(17);
    glm::dmat4 turn = glm::rotate(glm::dmat4(1), 0.6, glm::dvec3(1, 0.3, 0));
    Environment environment(image, 2, turn);
    glm::vec3 normal = glm::normalize(glm::vec3(0.2f, 0.1f, 1));
    Random random;
    double mass = 0, truth = 0;
    glm::dvec3 mean(0);
    constexpr int kSteps = 680; // a whole number per texel
    for (int i = 0; i < kSteps; ++i)
        for (int j = 0; j < kSteps; ++j) {
            glm::vec3 d = glm::mat3(turn) * equalAreaSquareToSphere((glm::vec2(i, j) + 0.5f) / float(kSteps));
            double element = 4 * double(kPi) / (kSteps * kSteps);
            mass += element * double(environment.pdf(normal, d));
            mean += element * double(environment.pdf(normal, d)) * glm::dvec3(d);
            truth += element * double(environment.radiance(d).y * std::max(0.f, glm::dot(normal, d)));
        }
    EXPECT_NEAR(mass, 1, 2e-3);
    glm::dvec3 sampledMean(0);
    constexpr int kSamples = 100000;
    Estimate e = average(kSamples, [&] {
        float chance = random.next1D();
        glm::vec3 d = environment.sample(normal, chance, random.next2D());
        sampledMean += glm::dvec3(d) / double(kSamples);
        return double(environment.radiance(d).y * std::max(0.f, glm::dot(normal, d)) /
                      environment.pdf(normal, d));
    });
    EXPECT_NEAR(e.mean, truth, 4 * e.error + 3e-3 * truth);
    EXPECT_LT(e.error * std::sqrt(double(kSamples)), truth); // the sun is not left to chance
    EXPECT_NEAR(glm::distance(mean, sampledMean), 0, 0.01);
}

TEST(Environment, aFlatSkyIsSampledWithoutNoise) {
    Image image = Image::rgb(8, 8);
    std::fill(image.pixels.begin(), image.pixels.end(), 0.75f);
    Environment environment(image, 2, glm::dmat4(1));
    Random random;
    for (int i = 0; i < 100; ++i) {
        float chance = random.next1D();
        glm::vec3 d = environment.sample({0, 1, 0}, chance, random.next2D());
        EXPECT_NEAR(environment.radiance(d).x * d.y / environment.pdf({0, 1, 0}, d), 1.5f * kPi, 1e-3f);
    }
}

TEST(Environment, imagesThatCannotBeUsedAreRefused) {
    Scene scene;
    scene.images.push_back(Image::rgb(8, 4));
    Light light;
    light.kind = LightKind::infinite;
    light.imageIndex = 0;
    scene.lights = {light};
    EXPECT_THROW(Lights{scene}, Error);
    scene.images[0] = Image::rgb(64, 64);
    EXPECT_NO_THROW(Lights{scene});
    scene.lights[0].illuminance = 3;
    EXPECT_THROW(Lights{scene}, Error); // black
    // The irradiance that pbrt normalises is twice what it says.
    std::fill(scene.images[0].pixels.begin(), scene.images[0].pixels.end(), 0.3f);
    EXPECT_NEAR(Lights(scene).infinite(0).meanRadiance().y, 3 / (kPi / 2), 0.02f);
}

} // namespace
} // namespace slant

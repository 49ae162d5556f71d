// Textures of noise, mappings and mixtures, against pbrt-v4's definitions.
#include "scene/scene.h"
#include "support/scene_text.h"
#include "trace/noise.h"
#include "trace/textures.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace slant {
namespace {

using test::worldOf;

/// The value of the last texture that is not constant.
glm::vec3 at(const Scene& scene, const TexturePoint& point) {
    int index = int(scene.textures.size()) - 1;
    while (scene.textures.at(std::size_t(index)).kind == TextureKind::constant) --index;
    return Textures(scene).evaluate(index, point, TextureUse::unbounded);
}
glm::vec3 atPlace(const Scene& scene, glm::vec3 position) {
    return at(scene, TexturePoint{position, {}});
}

TEST(Noise, isPerlins) {
    // Of the permutation and gradients by hand: cell 0 0 0, corner 0 has hash p[p[p[0]]] = p[p[151]] = p[17]
    // = 136.
    EXPECT_EQ(noise({0, 0, 0}), 0);
    EXPECT_EQ(noise({3, -7, 21}), 0); // at every corner
    std::mt19937 random(1);
    std::uniform_real_distribution<float> uniform(-50, 50);
    double sum = 0, squares = 0;
    constexpr int kCount = 20000;
    for (int i = 0; i < kCount; ++i) {
        const glm::vec3 p(uniform(random), uniform(random), uniform(random));
        const float value = noise(p);
        EXPECT_LE(std::abs(value), 1.04f);
        EXPECT_NEAR(noise(p + 256.f * glm::vec3(1, -1, 2)), value, 2e-3f); // the permutation's period
        EXPECT_NEAR(noise(p + glm::vec3(1e-3f)), value, 1e-2f);
        sum += double(value);
        squares += double(value * value);
    }
    EXPECT_NEAR(sum / kCount, 0, 0.01);
    EXPECT_NEAR(squares / kCount, 0.077, 0.01); // of improved noise
    EXPECT_EQ(noise({NAN, 0, 0}), 0);
    EXPECT_TRUE(std::isfinite(noise({1e30f, -1e30f, 1e20f})));
}

TEST(Noise, sumsOfOctaves) {
    const glm::vec3 p(0.3f, 1.7f, -2.2f);
    EXPECT_EQ(fractalNoise(p, 0.5f, 0), 0);
    EXPECT_EQ(fractalNoise(p, 0.5f, 1), noise(p));
    EXPECT_FLOAT_EQ(fractalNoise(p, 0.25f, 2), noise(p) + 0.25f * noise(1.99f * p));
    EXPECT_FLOAT_EQ(turbulence(p, 0.25f, 2), std::abs(noise(p)) + 0.25f * std::abs(noise(1.99f * p)));
}

TEST(NoiseTextures, ofScenes) {
    const glm::vec3 p(0.4f, 1.3f, 2.6f);
    EXPECT_EQ(atPlace(worldOf("Texture \"t\" \"float\" \"fbm\""), p).x, fractalNoise(p, 0.5f, 8));
    EXPECT_EQ(
        atPlace(worldOf("Scale .5 .5 .5 Texture \"t\" \"float\" \"wrinkled\" \"integer octaves\" 3 \"float "
                        "roughness\" .7"),
                p)
            .x,
        turbulence(2.f * p, 0.7f, 3));
    EXPECT_FLOAT_EQ(atPlace(worldOf("Texture \"t\" \"float\" \"windy\""), p).x,
                    std::abs(fractalNoise(0.1f * p, 0.5f, 3)) * fractalNoise(p, 0.5f, 6));
    // Marble without variation: stripes along y, 1.5 times the ends of the spline at the ends of the sine.
    const Scene marbleScene =
        worldOf("Texture \"t\" \"spectrum\" \"marble\" \"float variation\" 0 \"float scale\" 2");
    const auto expectColour = [&](float y, glm::vec3 colour) {
        const glm::vec3 value = atPlace(marbleScene, glm::vec3(5, y, -3));
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(value[c], 1.5f * colour[c], 1e-4f) << y;
    };
    expectColour(-0.25f * float(M_PI), {0.58f, 0.58f, 0.6f}); // sin -1
    expectColour(0.25f * float(M_PI), {0.58f, 0.58f, 0.6f});  // sin 1: the last control point
    expectColour(0, glm::vec3(0.5f));                         // the middle: segment 3 begins
}

TEST(NoiseTextures, dotsAreRoundAndInTheirCells) {
    int inside = 0, dotted = 0;
    constexpr int kCells = 40, kSteps = 40;
    for (int cell = 0; cell < kCells * kCells; ++cell) {
        int hits = 0;
        for (int i = 0; i < kSteps * kSteps; ++i)
            hits += isInDot({float(cell % kCells) - 0.5f + (float(i % kSteps) + 0.5f) / kSteps,
                             float(cell / kCells) - 0.5f + (float(i / kSteps) + 0.5f) / kSteps});
        dotted += hits > 0;
        inside += hits;
        EXPECT_NEAR(double(hits) / (kSteps * kSteps), hits > 0 ? M_PI * 0.35 * 0.35 : 0, 0.01);
    }
    // The noise in the middle of a cell is above 0 in 0.37 of them, and often 0.
    EXPECT_NEAR(double(dotted) / (kCells * kCells), 0.37, 0.04);
    EXPECT_GT(inside, 0);
    const Scene scene = worldOf("Texture \"t\" \"float\" \"dots\" \"float inside\" 3 \"float outside\" 5");
    for (const glm::vec2 uv : {glm::vec2(0.2f, 0.7f), glm::vec2(3, 4), glm::vec2(9, 2)})
        EXPECT_EQ(at(scene, {glm::vec3(0), uv}).x, isInDot(uv) ? 3 : 5);
}

TEST(Mappings, sphericalAndCylindrical) {
    const auto coordinates = [](const std::string& mapping, glm::vec3 p) {
        const std::string head =
            "Translate 1 2 3 Texture \"t\" \"float\" \"bilerp\" \"string mapping\" \"" + mapping + "\" ";
        // s and t themselves
        return glm::vec2(atPlace(worldOf(head + "\"float v01\" 0 \"float v10\" 1"), p).x,
                         atPlace(worldOf(head + "\"float v10\" 0"), p).x);
    };
    const glm::vec3 origin(1, 2, 3);
    const auto expectNear = [](glm::vec2 a, glm::vec2 b) {
        EXPECT_NEAR(a.x, b.x, 1e-5f);
        EXPECT_NEAR(a.y, b.y, 1e-5f);
    };
    expectNear(coordinates("spherical", origin + glm::vec3(2, 0, 0)), {0.5f, 0});
    expectNear(coordinates("spherical", origin + glm::vec3(0, 2, 0)), {0.5f, 0.25f});
    expectNear(coordinates("spherical", origin + glm::vec3(0, -1, 1)), {0.25f, 0.75f});
    EXPECT_NEAR(coordinates("spherical", origin + glm::vec3(0, 0, 5)).x, 0, 1e-5f);
    expectNear(coordinates("cylindrical", origin + glm::vec3(3, 0, 7)), {0.5f, 7});
    expectNear(coordinates("cylindrical", origin + glm::vec3(0, -1, -2)), {0.25f, -2});
    expectNear(coordinates("planar", origin + glm::vec3(4, 5, 6)), {4, 5});
}

TEST(Mappings, checkerboardOfThreeDimensions) {
    const Scene scene =
        worldOf("Scale 2 2 2 Texture \"t\" \"float\" \"checkerboard\" \"integer dimension\" 3");
    for (int i = 0; i < 8; ++i) {
        const glm::ivec3 cell(i & 1, i >> 1 & 1, i >> 2);
        EXPECT_EQ(atPlace(scene, 2.f * (glm::vec3(cell) + 0.5f)).x,
                  (cell.x + cell.y + cell.z) % 2 == 0 ? 1 : 0);
    }
    EXPECT_EQ(atPlace(scene, glm::vec3(-1)).x, 0); // cell -1 -1 -1
}

TEST(Mixtures, ofDirectionsColoursAndCorners) {
    const Scene scene = worldOf("Rotate 90 1 0 0\n"
                                "Texture \"t\" \"float\" \"directionmix\" \"float tex1\" 2 \"float tex2\" 6");
    const auto along = [&](glm::vec3 normal) { return at(scene, {glm::vec3(0), {}, normal}).x; };
    EXPECT_NEAR(along({0, 0, 1}), 2, 1e-5f); // +y of the texture is +z of the world
    EXPECT_NEAR(along({0, 0, -1}), 2, 1e-5f);
    EXPECT_NEAR(along({0, 1, 0}), 6, 1e-5f);
    EXPECT_NEAR(along({0, 0.8f, 0.6f}), 0.6f * 2 + 0.4f * 6, 1e-5f);
    const Scene bilerp =
        worldOf("Texture \"t\" \"spectrum\" \"bilerp\" \"rgb v00\" [1 0 0] \"rgb v01\" [0 1 0] \"rgb v10\" "
                "[0 0 1] \"rgb v11\" [1 1 1]");
    EXPECT_EQ(at(bilerp, {glm::vec3(0), {0, 0}}), glm::vec3(1, 0, 0));
    EXPECT_EQ(at(bilerp, {glm::vec3(0), {1, 0}}), glm::vec3(0, 0, 1));
    EXPECT_EQ(at(bilerp, {glm::vec3(0), {0, 1}}), glm::vec3(0, 1, 0));
    EXPECT_EQ(at(bilerp, {glm::vec3(0), {0.5f, 0.5f}}), glm::vec3(0.5f));
}

} // namespace
} // namespace slant

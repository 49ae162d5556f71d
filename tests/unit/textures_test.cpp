// Texture graphs against pbrt-v4's definitions.
#include "base/error.h"
#include "trace/textures.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

namespace slant {
namespace {

/// A scene with one 3 x 2 image whose texel (x, y) is (x, y, 0.5).
Scene withImage() {
    Scene scene;
    scene.images.push_back(Image::rgb(3, 2));
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 3; ++x) {
            scene.images[0].at(x, y, 0) = float(x);
            scene.images[0].at(x, y, 1) = float(y);
            scene.images[0].at(x, y, 2) = 0.5f;
        }
    return scene;
}

int add(Scene& scene, Texture t) {
    scene.textures.push_back(t);
    return int(scene.textures.size()) - 1;
}

Texture constant(float value) {
    Texture t;
    t.value = glm::vec3(value);
    return t;
}

Texture imagemap(WrapMode wrap, TexelFilter filter) {
    Texture t;
    t.kind = TextureKind::imagemap;
    t.imageIndex = 0;
    t.wrap = wrap;
    t.filter = filter;
    return t;
}

glm::vec3 at(const Scene& scene, glm::vec2 uv, TextureUse use = TextureUse::unbounded) {
    return Textures(scene).evaluate(int(scene.textures.size()) - 1, {glm::vec3(0), uv}, use);
}

TEST(Textures, imagesAreUpsideDownInT) {
    Scene scene = withImage();
    add(scene, imagemap(WrapMode::clamp, TexelFilter::point));
    EXPECT_EQ(at(scene, {0.1f, 0.9f}), glm::vec3(0, 0, 0.5f)); // top left is row 0
    EXPECT_EQ(at(scene, {0.9f, 0.9f}), glm::vec3(2, 0, 0.5f));
    EXPECT_EQ(at(scene, {0.5f, 0.1f}), glm::vec3(1, 1, 0.5f));
    EXPECT_EQ(at(scene, {7, -3}), glm::vec3(2, 1, 0.5f));
    EXPECT_EQ(at(scene, {NAN, 0.1f}), glm::vec3(0, 1, 0.5f)); // never outside memory
}

TEST(Textures, wrapModes) {
    Scene scene = withImage();
    add(scene, imagemap(WrapMode::repeat, TexelFilter::point));
    EXPECT_EQ(at(scene, {1.5f, 0.1f}), glm::vec3(1, 1, 0.5f));
    EXPECT_EQ(at(scene, {-0.1f, -0.9f}), glm::vec3(2, 1, 0.5f));
    scene.textures[0].wrap = WrapMode::black;
    EXPECT_EQ(at(scene, {1.2f, 0.5f}), glm::vec3(0));
    EXPECT_EQ(at(scene, {0.5f, 0.1f}), glm::vec3(1, 1, 0.5f));
}

TEST(Textures, bilinearBetweenTexelCentres) {
    Scene scene = withImage();
    add(scene, imagemap(WrapMode::repeat, TexelFilter::bilinear));
    EXPECT_NEAR(at(scene, {0.5f, 0.25f}).x, 1, 1e-6f);       // a centre
    EXPECT_NEAR(at(scene, {2.f / 3, 0.25f}).x, 1.5f, 1e-6f); // between two
    EXPECT_NEAR(at(scene, {0.5f, 0.5f}).y, 0.5f, 1e-6f);
    EXPECT_NEAR(at(scene, {0, 0.25f}).x, 1, 1e-6f); // across the seam: 2 and 0
    scene.textures[0].wrap = WrapMode::black;
    EXPECT_NEAR(at(scene, {1, 0.25f}).x, 1, 1e-6f); // 2 and nothing
    scene.textures[0].wrap = WrapMode::clamp;
    EXPECT_NEAR(at(scene, {1, 0.25f}).x, 2, 1e-6f);
}

TEST(Textures, scaleInvertAndUse) {
    Scene scene = withImage();
    Texture t = imagemap(WrapMode::clamp, TexelFilter::point);
    t.scale = 3;
    add(scene, t);
    EXPECT_EQ(at(scene, {0.5f, 0.1f}), glm::vec3(3, 3, 1.5f));
    EXPECT_EQ(at(scene, {0.5f, 0.1f}, TextureUse::albedo), glm::vec3(1));
    EXPECT_EQ(at(scene, {0.5f, 0.1f}, TextureUse::number), glm::vec3(2.5f));
    scene.textures[0].invert = true;
    scene.textures[0].scale = 1;
    EXPECT_EQ(at(scene, {0.9f, 0.9f}), glm::vec3(0, 1, 0.5f)); // 1 - 2 is clamped
}

TEST(Textures, checkerboardParityAndMappings) {
    Scene scene;
    add(scene, constant(10));
    add(scene, constant(20));
    Texture t;
    t.kind = TextureKind::checkerboard;
    t.child = {0, 1, -1};
    t.uvScale = {2, 4};
    t.uvDelta = {0.5f, 0};
    add(scene, t);
    auto expected = [](float s, float ti) {
        return (int(std::floor(s)) + int(std::floor(ti))) % 2 == 0 ? 10.f : 20.f;
    };
    for (float u : {-1.3f, -0.2f, 0.1f, 0.3f, 0.8f, 2.9f})
        for (float v : {-0.9f, 0.05f, 0.3f, 0.6f, 1.7f})
            EXPECT_EQ(at(scene, {u, v}).x, expected(2 * u + 0.5f, 4 * v)) << u << " " << v;

    scene.textures[2].mapping = TextureMapping::planar;
    scene.textures[2].planarV1 = {0, 2, 0};
    scene.textures[2].planarV2 = {0, 0, 1};
    scene.textures[2].textureFromWorld = glm::translate(glm::dmat4(1), glm::dvec3(0, 0.1, 0.4));
    for (float y : {-0.9f, 0.2f, 0.7f})
        for (float z : {0.1f, 0.7f, 5.3f})
            EXPECT_EQ(Textures(scene).evaluate(2, {{9, y, z}, {0, 0}}, TextureUse::unbounded).x,
                      expected(2 * (y + 0.1f) + 0.5f, z + 0.4f));
}

TEST(Textures, scaleAndMix) {
    Scene scene;
    int two = add(scene, constant(2)), quarter = add(scene, constant(0.25f));
    Texture scale;
    scale.kind = TextureKind::scale;
    scale.child = {two, quarter, -1};
    int half = add(scene, scale);
    EXPECT_EQ(at(scene, {0, 0}).x, 0.5f);
    Texture mix;
    mix.kind = TextureKind::mix;
    mix.child = {two, half, quarter};
    add(scene, mix);
    EXPECT_EQ(at(scene, {0, 0}).x, 0.75f * 2 + 0.25f * 0.5f);
    EXPECT_TRUE(Textures(scene).isConstant(3));
}

TEST(Textures, brokenGraphsAreRefused) {
    Scene scene;
    Texture scale;
    scale.kind = TextureKind::scale;
    scale.child = {0, 0, -1}; // itself
    add(scene, scale);
    EXPECT_THROW(Textures{scene}, Error);
    Scene second;
    add(second, imagemap(WrapMode::clamp, TexelFilter::point));
    EXPECT_THROW(Textures{second}, Error); // no image
}

} // namespace
} // namespace slant

#include "support/scene_text.h"

#include <gtest/gtest.h>

namespace slant {
namespace {

using test::sceneOf;
using test::worldOf;

TEST(SceneReader, hasPbrtsDefaults) {
    const Scene scene = worldOf("");
    EXPECT_EQ(scene.path, "s.pbrt");
    EXPECT_EQ(scene.film.xResolution, 1280);
    EXPECT_EQ(scene.film.yResolution, 720);
    EXPECT_EQ(scene.film.crop, (Rect{0, 0, 1280, 720}));
    EXPECT_EQ(scene.film.filename, "pbrt.exr");
    EXPECT_EQ(scene.film.imagingRatio, 1);
    EXPECT_EQ(scene.film.maxComponentValue, 0);
    EXPECT_EQ(scene.filter.kind, FilterKind::gaussian);
    EXPECT_EQ(scene.filter.radius, glm::vec2(1.5f));
    EXPECT_EQ(scene.filter.sigma, 0.5f);
    EXPECT_EQ(scene.camera.fovDegrees, 90);
    EXPECT_EQ(scene.camera.lensRadius, 0);
    EXPECT_EQ(scene.camera.focalDistance, 1e6f);
    EXPECT_EQ(scene.camera.screenMax, glm::vec2(1280.f / 720, 1));
    EXPECT_EQ(scene.camera.screenMin, -scene.camera.screenMax);
    EXPECT_EQ(scene.pixelSamples, 16);
    EXPECT_EQ(scene.maxDepth, 5);
    ASSERT_EQ(scene.materials.size(), 1u);
    EXPECT_EQ(scene.materials[0].kind, MaterialKind::diffuse);
    EXPECT_EQ(scene.textures.at(std::size_t(scene.materials[0].reflectance)).value, glm::vec3(0.5f));
}

TEST(SceneReader, readsAWholeScene) {
    const Scene scene = sceneOf(R"(
# a comment
LookAt 0 0 -5  0 0 0  0 1 0
Camera "perspective" "float fov" 40 "float lensradius" [0.1] "float focaldistance" [5]
Film "rgb" "integer xresolution" [64] "integer yresolution" 48 "string filename" "out.exr"
Sampler "halton" "integer pixelsamples" 8
Integrator "path" "integer maxdepth" 1
PixelFilter "box"
WorldBegin
LightSource "distant" "point3 from" [0 10 0] "point3 to" [0 0 0] "rgb L" [1 2 3] "float scale" 2
Texture "checks" "spectrum" "checkerboard" "float uscale" 8 "rgb tex1" [.1 .2 .3]
MakeNamedMaterial "floor" "string type" "diffuse" "texture reflectance" "checks"
AttributeBegin
  NamedMaterial "floor"
  Translate 0 -1 0
  Shape "trianglemesh" "point3 P" [-9 0 -9  9 0 -9  9 0 9  -9 0 9] "integer indices" [0 1 2 0 2 3]
    "point2 uv" [0 0 1 0 1 1 0 1]
AttributeEnd
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [5 5 5]
  Shape "sphere" "float radius" 0.5
AttributeEnd
ObjectBegin "thing"
  Shape "disk"
ObjectEnd
Scale 2 2 2
ObjectInstance "thing"
)");
    EXPECT_EQ(scene.maxDepth, 1);
    EXPECT_EQ(scene.pixelSamples, 8);
    EXPECT_EQ(scene.filter.radius, glm::vec2(0.5f));
    EXPECT_EQ(scene.camera.worldFromCamera.at[0][3], glm::dvec4(0, 0, -5, 1));
    ASSERT_EQ(scene.shapes.size(), 2u);
    EXPECT_EQ(scene.shapes[0].worldFromObject.at[1][3], glm::dvec4(0, -1, 0, 1));
    EXPECT_EQ(scene.shapes[0].materialIndex, 1);
    EXPECT_EQ(scene.shapes[1].materialIndex, 0);
    EXPECT_EQ(scene.shapes[1].areaLightIndex, 0);
    EXPECT_EQ(scene.areaLights[0].radiance, glm::vec3(5));
    ASSERT_EQ(scene.lights.size(), 1u);
    EXPECT_EQ(scene.lights[0].scale, 2);
    ASSERT_EQ(scene.instances.size(), 1u);
    EXPECT_EQ(scene.instances[0].worldFromInstance.at[0][1][1], 2);
    EXPECT_EQ(scene.objects[0].shapes[0].kind, ShapeKind::disk);
    const Texture& checks = scene.textures.at(std::size_t(scene.materials[1].reflectance));
    EXPECT_EQ(checks.kind, TextureKind::checkerboard);
    EXPECT_EQ(checks.uvScale, glm::vec2(8, 1));
    EXPECT_EQ(scene.textures.at(std::size_t(checks.child[1])).value, glm::vec3(0));
}

} // namespace
} // namespace slant

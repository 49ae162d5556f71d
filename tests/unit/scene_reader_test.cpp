#include "image/png.h"
#include "support/expect_error.h"
#include "support/ply_text.h"
#include "support/scene_text.h"
#include "support/temp_dir.h"

#include <gmock/gmock.h>
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

TEST(SceneReader, readsFilmAndFilter) {
    const auto film = [](const std::string& parameters) {
        return sceneOf("Film \"rgb\" \"integer xresolution\" 100 \"integer yresolution\" 50 " + parameters +
                       " WorldBegin")
            .film;
    };
    // x0 x1 y0 y1, in any order, rounded up in floats: 0.1f * 100 is 10.
    EXPECT_EQ(film("\"float cropwindow\" [.1 .255 1 .5]").crop, (Rect{10, 25, 26, 50}));
    EXPECT_EQ(film("\"integer pixelbounds\" [10 20 5 500]").crop, (Rect{10, 5, 20, 50}));
    EXPECT_EQ(film("\"integer pixelbounds\" [1 2 3 4] \"float cropwindow\" [0 1 0 1]").crop,
              (Rect{0, 0, 100, 50}));
    EXPECT_EQ(film("\"float iso\" 200").imagingRatio, 2);
    EXPECT_EQ(film("\"float maxcomponentvalue\" 10 \"bool savefp16\" false \"float diagonal\" 20")
                  .maxComponentValue,
              10);
    EXPECT_EQ(sceneOf("Camera \"perspective\" \"float shutterclose\" .25 Film \"rgb\" WorldBegin")
                  .film.imagingRatio,
              .25f);

    const auto filter = [](const std::string& text) {
        return sceneOf("PixelFilter " + text + " WorldBegin").filter;
    };
    EXPECT_EQ(filter("\"triangle\"").radius, glm::vec2(2));
    EXPECT_EQ(filter("\"mitchell\"").radius, glm::vec2(2));
    EXPECT_EQ(filter("\"mitchell\" \"float B\" 0 \"float C\" .5").c, .5f);
    EXPECT_EQ(filter("\"sinc\" \"float xradius\" 3").radius, glm::vec2(3, 4));
    EXPECT_EQ(filter("\"sinc\"").tau, 3);
    EXPECT_EQ(filter("\"gaussian\" \"float sigma\" 1").sigma, 1);
}

TEST(SceneReader, derivesTheScreenWindow) {
    const auto camera = [](const std::string& text) {
        return sceneOf("Film \"rgb\" \"integer xresolution\" 100 \"integer yresolution\" 200 Camera "
                       "\"perspective\" " +
                       text + " WorldBegin")
            .camera;
    };
    EXPECT_EQ(camera("").screenMax, glm::vec2(1, 2));
    EXPECT_EQ(camera("\"float frameaspectratio\" 4").screenMax, glm::vec2(4, 1));
    EXPECT_EQ(camera("\"float screenwindow\" [-1 2 -3 4]").screenMin, glm::vec2(-1, -3));
    EXPECT_EQ(camera("\"float screenwindow\" [-1 2 -3 4]").screenMax, glm::vec2(2, 4));
}

TEST(SceneReader, readsSamplersByAnyName) {
    EXPECT_EQ(sceneOf("Sampler \"stratified\" \"integer xsamples\" 3 \"integer ysamples\" 5 \"bool jitter\" "
                      "false WorldBegin")
                  .pixelSamples,
              15);
    for (const char* name : {"halton", "independent", "paddedsobol", "sobol", "zsobol", "pmj02bn"})
        EXPECT_EQ(
            sceneOf(fmt::format("Sampler \"{}\" \"integer pixelsamples\" [ 7 ] \"integer seed\" 3 WorldBegin",
                                name))
                .pixelSamples,
            7);
    EXPECT_EQ(
        sceneOf("Integrator \"volpath\" \"integer maxdepth\" 0 \"string lightsampler\" \"power\" WorldBegin")
            .maxDepth,
        0);
}

TEST(SceneReader, ignoresWhatCannotChangeThePicture) {
    EXPECT_EQ(
        test::errorOf(
            "Option \"seed\" 3 Option \"disable-pixel-jitter\" false Option \"rendercoordsys\" \"world\"\n"
            "Accelerator \"kdtree\" \"integer maxprims\" 1 ColorSpace \"srgb\" MediumInterface \"\" \"\" "
            "WorldBegin\n"
            "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \"integer faceIndices\" 0 \"float "
            "alpha\" 1"),
        "");
}

TEST(SceneReader, readsShapes) {
    const Scene scene = worldOf(
        "ReverseOrientation\n"
        "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \"normal N\" [0 0 1 0 0 1 0 0 1]\n"
        "ReverseOrientation\n"
        "Shape \"bilinearmesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 1] \"point2 uv\" [0 0 1 0 0 1 1 1]\n"
        "Shape \"sphere\" \"float radius\" 2 \"float zmin\" 5 \"float zmax\" -1 \"float phimax\" 400\n"
        "Shape \"disk\" \"float height\" 1 \"float radius\" 3 \"float innerradius\" 2 \"float phimax\" 90\n");
    ASSERT_EQ(scene.shapes.size(), 4u);
    const Mesh& triangle = scene.meshes.at(0);
    EXPECT_EQ(triangle.kind, Mesh::Kind::triangles);
    EXPECT_EQ(triangle.indices, (std::vector<std::uint32_t>{0, 1, 2}));
    EXPECT_EQ(triangle.normals.size(), 3u);
    EXPECT_TRUE(scene.shapes[0].reverseOrientation);
    EXPECT_EQ(scene.meshes.at(1).kind, Mesh::Kind::bilinearPatches);
    EXPECT_EQ(scene.meshes.at(1).indices, (std::vector<std::uint32_t>{0, 1, 2, 3}));
    EXPECT_FALSE(scene.shapes[1].reverseOrientation);
    EXPECT_EQ(scene.shapes[2].zMin, -1);
    EXPECT_EQ(scene.shapes[2].zMax, 2);
    EXPECT_EQ(scene.shapes[2].phiMaxDegrees, 360);
    EXPECT_EQ(scene.shapes[3].height, 1);
    EXPECT_EQ(scene.shapes[3].innerRadius, 2);
    EXPECT_EQ(scene.shapes[3].location.text(), "s.pbrt:7:1");
}

TEST(SceneReader, letsTheLastOfEqualParametersCount) {
    EXPECT_EQ(worldOf("Shape \"sphere\" \"float radius\" 2 \"float radius\" 3").shapes.at(0).radius, 3);
    EXPECT_EQ(
        sceneOf("Film \"rgb\" \"integer xresolution\" 9 Film \"rgb\" \"integer yresolution\" 8 WorldBegin")
            .film.xResolution,
        1280);
}

TEST(SceneReader, readsOtherFiles) {
    const test::TempDir dir;
    std::filesystem::create_directory(dir.path() / "sub");
    test::writeText(dir.file("main.pbrt"), "WorldBegin Translate 1 0 0\n"
                                           "Include \"sub/inner.pbrt\" Shape \"sphere\"\n"
                                           "Import \"sub/inner.pbrt\" Shape \"sphere\"\n");
    // Names count from the main file's directory, also in an included file.
    test::writeText(dir.file("sub/inner.pbrt"),
                    "Translate 0 1 0 Shape \"plymesh\" \"string filename\" \"sub/m.ply\"\n");
    test::writeText(dir.file("sub/m.ply"), test::gzipped(test::samplePly(test::PlyFormat::bigEndian)));
    test::RecordingMonitor monitor;
    const Scene scene = readScene(dir.file("main.pbrt"), monitor);
    ASSERT_EQ(scene.shapes.size(), 6u); // triangles and quads of the PLY file are two shapes
    ASSERT_EQ(scene.meshes.size(), 2u); // read once
    const glm::dvec4 places[] = {{1, 1, 0, 1}, {1, 1, 0, 1}, {1, 1, 0, 1},
                                 {1, 2, 0, 1}, {1, 2, 0, 1}, {1, 1, 0, 1}};
    for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(scene.shapes[i].worldFromObject.at[0][3], places[i]) << i;
    const std::string inner = dir.file("sub/inner.pbrt"), ply = dir.file("sub/m.ply");
    EXPECT_THAT(scene.files, testing::ElementsAre(dir.file("main.pbrt"), inner, ply, inner));
    ASSERT_EQ(monitor.warnings.size(), 1u);
    EXPECT_THAT(monitor.warnings[0],
                testing::EndsWith("m.ply: 1 faces have neither 3 nor 4 vertices and are left out"));
}

TEST(SceneReader, readsAperturesByNameAndFromImages) {
    const test::TempDir dir;
    const std::string file = dir.file("main.pbrt"), image = dir.file("half.png");
    writePng(image, {2, 1, 1, {255, 0}});
    writePng(dir.file("black.png"), {1, 1, 1, {0}});
    SilentMonitor monitor;
    const auto camera = [&](const std::string& aperture) {
        test::writeText(file, "Camera \"perspective\" \"string aperture\" \"" + aperture + "\" WorldBegin");
        return readScene(file, monitor);
    };
    EXPECT_EQ(camera("").camera.aperture.name, "disc"); // as in pbrt
    EXPECT_EQ(camera("star").camera.aperture.rim.size(), 10u);
    EXPECT_EQ(camera("polygon 6 12").camera.aperture.name, "polygon 6 12");
    const Scene scene = camera("half.png");
    EXPECT_EQ(scene.camera.aperture.weights.size(), 512u * 128u);
    EXPECT_EQ(scene.camera.aperture.weights.at(0), 0); // to the right
    EXPECT_EQ(scene.camera.aperture.weights.at(256 * 128), 255);
    EXPECT_THAT(scene.files, testing::ElementsAre(file, image));
    test::expectError(ErrorCode::badInput, file + ":1:22: the image of the aperture is black",
                      [&] { camera("black.png"); });
}

TEST(SceneReader, warnsWithThePlace) {
    test::RecordingMonitor monitor;
    readSceneText("Film \"rgb\" \"integer pixelbounds\" [0 9999 0 5]\nWorldBegin\n"
                  "TransformBegin TransformEnd\n"
                  "AreaLightSource \"diffuse\" ObjectBegin \"o\" Shape \"sphere\" ObjectEnd\n"
                  "ActiveTransform StartTime Translate 1 0 0 LightSource \"point\"",
                  "w.pbrt", monitor);
    EXPECT_THAT(monitor.warnings,
                testing::ElementsAre(
                    "w.pbrt:1:12: 'pixelbounds' reach beyond the film and are clipped to it",
                    "w.pbrt:3:1: TransformBegin and TransformEnd are deprecated and mean AttributeBegin and "
                    "AttributeEnd",
                    "w.pbrt:4:43: shapes of an object cannot emit light, as in pbrt; this one is dark",
                    "w.pbrt:5:43: a light does not move; its transform at the start is used"));
}

} // namespace
} // namespace slant

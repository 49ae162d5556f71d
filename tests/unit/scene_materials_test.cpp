#include "image/exr.h"
#include "image/png.h"
#include "scene/spectra.h"
#include "support/scene_text.h"
#include "support/temp_dir.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace slant {
namespace {

using test::errorOf;
using test::worldOf;
using testing::HasSubstr;

const Texture& textureAt(const Scene& scene, int index) {
    return scene.textures.at(std::size_t(index));
}

std::vector<const Texture*> ofKind(const Scene& scene, TextureKind kind) {
    std::vector<const Texture*> found;
    for (const Texture& texture : scene.textures)
        if (texture.kind == kind) found.push_back(&texture);
    return found;
}

TEST(SceneMaterials, haveTheirDefaults) {
    const Scene scene = worldOf("Material \"coateddiffuse\" Material \"conductor\"");
    const Material& coated = scene.materials.at(1);
    EXPECT_EQ(coated.kind, MaterialKind::coatedDiffuse);
    EXPECT_EQ(textureAt(scene, coated.reflectance).value, glm::vec3(0.5f));
    EXPECT_EQ(textureAt(scene, coated.uRoughness).value.x, 0);
    EXPECT_EQ(coated.uRoughness, coated.vRoughness);
    EXPECT_TRUE(coated.remapRoughness);
    EXPECT_EQ(coated.interfaceEta, 1.5f);
    EXPECT_EQ(textureAt(scene, coated.thickness).value.x, 0.01f);
    EXPECT_EQ(coated.g, 0);
    EXPECT_EQ(textureAt(scene, coated.albedo).value, glm::vec3(0));
    EXPECT_EQ(coated.maxDepth, 10);
    EXPECT_EQ(coated.sampleCount, 1);
    const Material& copper = scene.materials.at(2);
    EXPECT_EQ(copper.kind, MaterialKind::conductor);
    EXPECT_EQ(copper.reflectance, -1);
    EXPECT_EQ(textureAt(scene, copper.eta).value, metalSpectrum("metal-Cu-eta"));
    EXPECT_EQ(textureAt(scene, copper.k).value, metalSpectrum("metal-Cu-k"));
}

TEST(SceneMaterials, readTheirParameters) {
    const Scene scene = worldOf(
        "Material \"conductor\" \"rgb reflectance\" [.9 .8 .7] \"float uroughness\" .1 \"float roughness\" "
        ".3 "
        "\"bool remaproughness\" false\n"
        "Material \"conductor\" \"spectrum eta\" \"metal-Au-eta\" \"spectrum k\" [300 2.5 900 2.5]\n"
        "Material \"coateddiffuse\" \"spectrum eta\" \"glass-BK7\" \"integer maxdepth\" 4 \"float g\" -.5\n");
    const Material& mirror = scene.materials.at(1);
    EXPECT_EQ(textureAt(scene, mirror.reflectance).value, glm::vec3(.9f, .8f, .7f));
    EXPECT_EQ(mirror.eta, -1);
    EXPECT_EQ(textureAt(scene, mirror.uRoughness).value.x, .1f);
    EXPECT_EQ(textureAt(scene, mirror.vRoughness).value.x, .3f);
    EXPECT_FALSE(mirror.remapRoughness);
    EXPECT_EQ(textureAt(scene, scene.materials.at(2).eta).value, metalSpectrum("metal-Au-eta"));
    EXPECT_EQ(textureAt(scene, scene.materials.at(2).k).value, glm::vec3(2.5f));
    EXPECT_EQ(scene.materials.at(3).interfaceEta, 1.5168f);
    EXPECT_EQ(scene.materials.at(3).maxDepth, 4);
    EXPECT_EQ(scene.materials.at(3).g, -.5f);
}

TEST(SceneMaterials, canBeNamedBeforeTheyAreMade) {
    const Scene scene =
        worldOf("NamedMaterial \"later\" Shape \"sphere\"\n"
                "MakeNamedMaterial \"later\" \"string type\" \"diffuse\" \"texture reflectance\" \"t\"\n"
                "Texture \"t\" \"spectrum\" \"mix\" \"texture tex1\" \"u\" \"float amount\" .25\n"
                "Texture \"u\" \"spectrum\" \"constant\" \"rgb value\" [.1 .2 .3]");
    const Material& material = scene.materials.at(std::size_t(scene.shapes.at(0).materialIndex));
    const Texture& mix = textureAt(scene, material.reflectance);
    EXPECT_EQ(mix.kind, TextureKind::mix);
    for (const int child : mix.child) EXPECT_LT(child, material.reflectance);
    EXPECT_EQ(textureAt(scene, mix.child[0]).value, glm::vec3(.1f, .2f, .3f));
    EXPECT_EQ(textureAt(scene, mix.child[1]).value, glm::vec3(1));
    EXPECT_EQ(textureAt(scene, mix.child[2]).value.x, .25f);
}

TEST(SceneTextures, takeDefaultsFromAttributes) {
    const Scene scene =
        worldOf("AttributeBegin\n"
                "Attribute \"material\" \"rgb reflectance\" [.2 .2 .2] \"float roughness\" .5\n"
                "Attribute \"shape\" \"float radius\" 3\n"
                "Attribute \"light\" \"float scale\" 7\n"
                "Material \"diffuse\" Shape \"sphere\" Shape \"sphere\" \"float radius\" 2 Shape \"disk\"\n"
                "LightSource \"point\"\n"
                "AttributeEnd\n"
                "Material \"diffuse\" Shape \"sphere\" LightSource \"point\"");
    EXPECT_EQ(textureAt(scene, scene.materials.at(1).reflectance).value, glm::vec3(.2f));
    EXPECT_EQ(textureAt(scene, scene.materials.at(2).reflectance).value, glm::vec3(.5f));
    EXPECT_EQ(scene.shapes.at(0).radius, 3);
    EXPECT_EQ(scene.shapes.at(1).radius, 2);
    EXPECT_EQ(scene.shapes.at(2).radius, 3);
    EXPECT_EQ(scene.shapes.at(3).radius, 1);
    EXPECT_EQ(scene.lights.at(0).scale, 7);
    EXPECT_EQ(scene.lights.at(1).scale, 1);
}

TEST(SceneTextures, keepTheSpaceOfTheirDirective) {
    const Scene scene = worldOf("Translate 0 3 0 Scale 2 2 2\n"
                                "Texture \"p\" \"float\" \"checkerboard\" \"string mapping\" \"planar\" "
                                "\"vector3 v1\" [1 0 1] \"float udelta\" .5");
    const Texture& texture = *ofKind(scene, TextureKind::checkerboard).at(0);
    EXPECT_EQ(texture.mapping, TextureMapping::planar);
    EXPECT_EQ(texture.textureFromWorld * glm::dvec4(2, 5, 4, 1), glm::dvec4(1, 1, 2, 1));
    EXPECT_EQ(texture.planarV1, glm::vec3(1, 0, 1));
    EXPECT_EQ(texture.planarV2, glm::vec3(0, 1, 0));
    EXPECT_EQ(texture.uvDelta, glm::vec2(.5f, 0));
    EXPECT_EQ(textureAt(scene, texture.child[0]).value.x, 1);
    EXPECT_EQ(textureAt(scene, texture.child[1]).value.x, 0);
}

TEST(SceneTextures, decodeImages) {
    const test::TempDir dir;
    writePng(dir.file("rgb.png"), {2, 1, 3, {255, 128, 0, 64, 64, 64}});
    writePng(dir.file("grey.png"), {1, 1, 1, {128}});
    Image linear = Image::rgb(1, 1);
    linear.pixels = {2, 0.25f, 0.5f};
    writeExr(dir.file("linear.exr"), linear);

    const float half = 128 / 255.f, halfDecoded = 0.2158605f, quarterDecoded = 0.0512695f;
    const struct {
        const char *type, *file, *encoding;
        std::vector<float> pixels;
    } cases[] = {
        {"spectrum", "rgb.png", "", {1, halfDecoded, 0, quarterDecoded, quarterDecoded, quarterDecoded}},
        {"spectrum", "rgb.png", "gamma 2", {1, half * half, 0, .0629911f, .0629911f, .0629911f}},
        {"spectrum", "linear.exr", "sRGB", {2, 0.25f, 0.5f}}, // floats are linear whatever is said
        {"float", "rgb.png", "linear", {(1 + half) / 3, 64 / 255.f}},
        {"float", "linear.exr", "", {2.75f / 3}},
        {"spectrum", "grey.png", "linear", {half}},
    };
    for (const auto& c : cases) {
        std::string text = fmt::format(
            "WorldBegin Texture \"t\" \"{}\" \"imagemap\" \"string filename\" \"{}\"", c.type, c.file);
        if (*c.encoding) text += fmt::format(" \"string encoding\" \"{}\"", c.encoding);
        SilentMonitor monitor;
        const Scene scene = readSceneText(text, dir.file("s.pbrt"), monitor);
        EXPECT_THAT(scene.images.at(0).pixels, testing::Pointwise(testing::FloatNear(1e-6f), c.pixels))
            << text;
    }
}

TEST(SceneTextures, shareTheImagesOfOneFile) {
    const test::TempDir dir;
    writePng(dir.file("a.png"), {1, 1, 3, {1, 2, 3}});
    SilentMonitor monitor;
    const Scene scene = readSceneText("WorldBegin Texture \"a\" \"spectrum\" \"imagemap\" \"string "
                                      "filename\" \"a.png\" \"string wrap\" \"clamp\"\n"
                                      "Texture \"b\" \"spectrum\" \"imagemap\" \"string filename\" \"a.png\" "
                                      "\"bool invert\" true \"float scale\" 2 "
                                      "\"string filter\" \"point\" \"float maxanisotropy\" 4\n",
                                      dir.file("s.pbrt"), monitor);
    const std::vector<const Texture*> maps = ofKind(scene, TextureKind::imagemap);
    ASSERT_EQ(maps.size(), 2u);
    EXPECT_EQ(scene.images.size(), 1u);
    EXPECT_EQ(maps[0]->wrap, WrapMode::clamp);
    EXPECT_EQ(maps[0]->filter, TexelFilter::bilinear);
    EXPECT_EQ(maps[1]->wrap, WrapMode::repeat);
    EXPECT_EQ(maps[1]->filter, TexelFilter::point);
    EXPECT_TRUE(maps[1]->invert);
    EXPECT_EQ(maps[1]->scale, 2);
}

TEST(SceneLights, areReadWithTheirUnits) {
    const Scene scene =
        worldOf("Translate 1 0 0\n"
                "LightSource \"point\" \"rgb I\" [1 2 3] \"float power\" 60 \"point3 from\" [0 1 0]\n"
                "LightSource \"distant\" \"float illuminance\" 500\n"
                "LightSource \"infinite\" \"spectrum L\" \"stdillum-D65\" \"float scale\" .5\n"
                "AreaLightSource \"diffuse\" \"float power\" 10 \"bool twosided\" true Shape \"disk\"\n");
    const Light& point = scene.lights.at(0);
    EXPECT_EQ(point.kind, LightKind::point);
    EXPECT_EQ(point.emission, glm::vec3(1, 2, 3));
    EXPECT_EQ(point.power, 60);
    EXPECT_EQ(point.from, glm::vec3(0, 1, 0));
    EXPECT_EQ(point.worldFromLight[3], glm::dvec4(1, 0, 0, 1));
    EXPECT_EQ(scene.lights.at(1).illuminance, 500);
    EXPECT_EQ(scene.lights.at(1).emission, glm::vec3(1));
    EXPECT_EQ(scene.lights.at(1).to, glm::vec3(0, 0, 1));
    EXPECT_EQ(scene.lights.at(2).emission, glm::vec3(1));
    EXPECT_EQ(scene.lights.at(2).scale, .5f);
    EXPECT_EQ(scene.areaLights.at(0).power, 10);
    EXPECT_TRUE(scene.areaLights.at(0).twoSided);
}

TEST(SceneLights, takeSquareMapsAndThoseByLatitudeAndLongitude) {
    const test::TempDir dir;
    writeExr(dir.file("sky.exr"), Image::rgb(4, 4));
    writeExr(dir.file("latlong.exr"), Image::rgb(8, 4));
    writeExr(dir.file("wide.exr"), Image::rgb(4, 3));
    SilentMonitor monitor;
    const std::string light = "WorldBegin LightSource \"infinite\" \"string filename\" ";
    EXPECT_EQ(readSceneText(light + "\"sky.exr\"", dir.file("s.pbrt"), monitor).lights.at(0).imageIndex, 0);
    const Scene latLong = readSceneText(light + "\"latlong.exr\"", dir.file("s.pbrt"), monitor);
    const Image& made = latLong.images.at(std::size_t(latLong.lights.at(0).imageIndex));
    EXPECT_EQ(made.width(), 6);
    EXPECT_EQ(made.height(), 6);
    try {
        readSceneText(light + "\"wide.exr\"", dir.file("s.pbrt"), monitor);
        ADD_FAILURE();
    } catch (const Error& error) {
        EXPECT_THAT(error.what(),
                    HasSubstr("s.pbrt:1:35: the image of an infinite light must be square (equal-area "
                              "octahedral), or twice as wide as high (latitude and longitude), but wide.exr "
                              "is 4x3"));
    }
}

TEST(Spectra, blackBodiesHaveLuminanceOneAndTheirColour) {
    for (const double kelvin : {2000., 3000., 5000., 6500., 10000.}) {
        const glm::dvec3 rgb(blackbodyRgb(kelvin));
        EXPECT_NEAR(0.2126 * rgb.r + 0.7152 * rgb.g + 0.0722 * rgb.b, 1, 2e-3);
        // The Planckian locus: Kim et al., US patent 7024034, cubic fit.
        const double t = 1e3 / kelvin;
        const double x = kelvin < 4000 ? ((-0.2661239 * t - 0.2343589) * t + 0.8776956) * t + 0.179910
                                       : ((-3.0258469 * t + 2.1070379) * t + 0.2226347) * t + 0.240390;
        const glm::dvec3 xyz(0.4124 * rgb.r + 0.3576 * rgb.g + 0.1805 * rgb.b, 1,
                             0.0193 * rgb.r + 0.1192 * rgb.g + 0.9505 * rgb.b);
        EXPECT_NEAR(xyz.x / (xyz.x + xyz.y + xyz.z), x, 4e-3) << kelvin;
    }
    EXPECT_EQ(blackbodyRgb(1000).b, 0);
}

TEST(Spectra, metalsReflectTheirColour) {
    const auto reflectance = [](const char* metal) {
        const glm::vec3 n = *metalSpectrum(fmt::format("metal-{}-eta", metal));
        const glm::vec3 k = *metalSpectrum(fmt::format("metal-{}-k", metal));
        return ((n - 1.f) * (n - 1.f) + k * k) / ((n + 1.f) * (n + 1.f) + k * k);
    };
    // Normal incidence of pbrt's spectra under D65, linear Rec.709.
    const std::pair<const char*, glm::vec3> expected[] = {
        {"Ag", {0.9713f, 0.9601f, 0.9154f}},  {"Al", {0.9133f, 0.9215f, 0.9245f}},
        {"Au", {1.0000f, 0.7837f, 0.3432f}},  {"Cu", {0.9530f, 0.6387f, 0.5380f}},
        {"MgO", {0.0721f, 0.0731f, 0.0749f}}, {"TiO2", {0.2325f, 0.2441f, 0.2727f}}};
    for (const auto& [metal, colour] : expected)
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(reflectance(metal)[c], colour[c], 5e-3) << metal;
    EXPECT_FALSE(metalSpectrum("metal-Fe-eta"));
}

} // namespace
} // namespace slant

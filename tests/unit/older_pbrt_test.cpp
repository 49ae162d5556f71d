// Text of pbrt-v2 and -v3 is read as the pbrt-v4 text that stands beside it.
#include "camera/compound_lens.h"
#include "support/scene_text.h"
#include "support/temp_dir.h"

#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace slant {
namespace {

using test::sceneOf;
using test::worldOf;

std::vector<std::string> warningsOf(const std::string& text) {
    test::RecordingMonitor monitor;
    readSceneText(text, "s.pbrt", monitor);
    return monitor.warnings;
}

const Texture& reflectanceOf(const Scene& scene, std::size_t material) {
    return scene.textures.at(std::size_t(scene.materials.at(material).reflectance));
}

TEST(OlderPbrt, saysSoOnce) {
    EXPECT_THAT(warningsOf("Film \"image\" Renderer \"sampler\" WorldBegin Material \"matte\" WorldEnd"),
                testing::ElementsAre("s.pbrt:1:1: this is of an older pbrt; the scene is read as pbrt's own "
                                     "upgrade translates it"));
    EXPECT_THAT(warningsOf("Film \"rgb\" WorldBegin Material \"diffuse\""), testing::IsEmpty());
    EXPECT_THAT(warningsOf("WorldBegin Material \"plastic\" \"color Ks\" [.1 .1 .1]"),
                testing::Contains("s.pbrt:1:12: 'Ks' of the older material \"plastic\" is dropped"));
}

TEST(OlderPbrt, options) {
    const Scene scene =
        sceneOf("Film \"image\" \"integer xresolution\" 64 \"integer yresolution\" 48 "
                "\"float scale\" 2.5 \"float maxsampleluminance\" 7\n"
                "PixelFilter \"gaussian\" \"float xwidth\" 3 \"float ywidth\" 2 \"float alpha\" 2\n"
                "Sampler \"lowdiscrepancy\" \"integer pixelsamples\" 5\n"
                "SurfaceIntegrator \"directlighting\" \"string strategy\" \"one\"\n"
                "VolumeIntegrator \"emission\"\n"
                "WorldBegin");
    EXPECT_EQ(scene.film.xResolution, 64);
    EXPECT_FLOAT_EQ(scene.film.imagingRatio, 2.5f);
    EXPECT_EQ(scene.film.maxComponentValue, 7);
    EXPECT_EQ(scene.filter.radius, glm::vec2(3, 2));
    EXPECT_FLOAT_EQ(scene.filter.sigma, 0.5f);
    EXPECT_EQ(scene.pixelSamples, 5);
    EXPECT_EQ(scene.maxDepth, 1);
    EXPECT_EQ(sceneOf("Sampler \"adaptive\" \"integer minsamples\" 2 \"integer maxsamples\" 9 WorldBegin")
                  .pixelSamples,
              9);
}

TEST(OlderPbrt, materials) {
    const Scene scene = worldOf(
        "Material \"matte\" \"color Kd\" [.1 .2 .3] \"float sigma\" 20\n"
        "Material \"plastic\" \"color Kd\" [.4 .5 .6] \"color Ks\" [.1 .1 .1] \"float roughness\" .05\n"
        "Material \"plastic\" \"color Kd\" [.4 .5 .6] \"color Ks\" [0 0 0] \"float roughness\" .05\n"
        "Material \"uber\" \"rgb Kd\" [.7 .7 .7] \"float index\" 1.3 \"rgb opacity\" [1 1 1]\n"
        "Material \"substrate\" \"color Kd\" [.3 .3 .3] \"color Ks\" [.5 .5 .5] \"float uroughness\" .1\n"
        "Material \"mirror\" \"color Kr\" [.9 .9 .9]\n"
        "Material \"metal\" \"float roughness\" .2\n"
        "Material \"disney\" \"color color\" [.2 .2 .2] \"float metallic\" 1");
    using Kind = MaterialKind;
    const Kind kinds[] = {Kind::diffuse,   Kind::diffuse,       Kind::coatedDiffuse,
                          Kind::diffuse,   Kind::coatedDiffuse, Kind::coatedDiffuse,
                          Kind::conductor, Kind::conductor,     Kind::diffuse};
    for (std::size_t i = 0; i < std::size(kinds); ++i) EXPECT_EQ(scene.materials.at(i).kind, kinds[i]) << i;
    EXPECT_EQ(reflectanceOf(scene, 1).value, glm::vec3(.1f, .2f, .3f));
    EXPECT_EQ(reflectanceOf(scene, 2).value, glm::vec3(.4f, .5f, .6f));
    EXPECT_EQ(reflectanceOf(scene, 3).value, glm::vec3(.4f, .5f, .6f));
    EXPECT_EQ(scene.materials[4].interfaceEta, 1.3f);
    EXPECT_EQ(reflectanceOf(scene, 8).value, glm::vec3(.2f));
    const Scene silver =
        worldOf("Material \"conductor\" \"spectrum eta\" \"metal-Ag-eta\" \"spectrum k\" \"metal-Ag-k\"");
    const auto etaOf = [](const Scene& s, std::size_t i) {
        return s.textures.at(std::size_t(s.materials.at(i).eta)).value;
    };
    EXPECT_EQ(etaOf(scene, 6), etaOf(silver, 1));
    // Metals by the files that came with pbrt-v2.
    const Scene gold =
        worldOf("Material \"metal\" \"spectrum eta\" \"spds/metals/Au.eta.spd\" \"spectrum k\" "
                "\"spds/metals/Au.k.spd\"\n"
                "Material \"conductor\" \"spectrum eta\" \"metal-Au-eta\" \"spectrum k\" \"metal-Au-k\"");
    EXPECT_EQ(etaOf(gold, 1), etaOf(gold, 2));
}

TEST(OlderPbrt, namesMayBeTakenAgain) {
    const Scene scene = worldOf("MakeNamedMaterial \"a\" \"string type\" \"matte\" \"color Kd\" [.1 .1 .1]\n"
                                "NamedMaterial \"a\" Shape \"sphere\"\n"
                                "MakeNamedMaterial \"a\" \"string type\" \"matte\" \"color Kd\" [.2 .2 .2]\n"
                                "NamedMaterial \"a\" Shape \"sphere\"");
    EXPECT_EQ(reflectanceOf(scene, std::size_t(scene.shapes.at(0).materialIndex)).value, glm::vec3(.1f));
    EXPECT_EQ(reflectanceOf(scene, std::size_t(scene.shapes.at(1).materialIndex)).value, glm::vec3(.2f));
}

TEST(OlderPbrt, texturesLightsShapes) {
    const Scene scene =
        worldOf("Texture \"a\" \"color\" \"constant\" \"color value\" [.1 .2 .3]\n"
                "Texture \"b\" \"color\" \"scale\" \"texture tex1\" \"a\" \"color tex2\" [.5 .5 .5]\n"
                "Texture \"c\" \"color\" \"scale\" \"texture tex1\" \"a\" \"color tex2\" [.5 .6 .5]\n"
                "LightSource \"point\" \"color I\" [1 2 3] \"color scale\" [2 2 2] \"point from\" [1 2 3] "
                "\"integer nsamples\" 4\n"
                "LightSource \"infinite\" \"blackbody L\" [5000 3]\n"
                "AreaLightSource \"area\" \"color L\" [1 1 1]\n"
                "Shape \"trianglemesh\" \"point P\" [0 0 0 1 0 0 0 1 0] \"float st\" [0 0 1 0 0 1] \"bool "
                "discarddegenerateUVs\" \"true\"");
    EXPECT_EQ(scene.lights.at(0).scale, 2);
    EXPECT_EQ(scene.lights.at(0).from, glm::vec3(1, 2, 3));
    EXPECT_EQ(scene.lights.at(1).scale, 3);
    EXPECT_EQ(scene.areaLights.size(), 1u);
    EXPECT_EQ(scene.meshes.at(0).uvs.at(1), glm::vec2(1, 0));
    const auto count = [&](TextureKind kind) {
        return std::count_if(scene.textures.begin(), scene.textures.end(),
                             [&](const Texture& t) { return t.kind == kind; });
    };
    EXPECT_EQ(count(TextureKind::scale), 1);
    EXPECT_EQ(count(TextureKind::product), 1);
}

TEST(OlderPbrt, coloursOfLightsMultiply) {
    const Scene scene = worldOf("LightSource \"point\" \"color I\" [1 2 3] \"color scale\" [2 1 .5]\n"
                                "AreaLightSource \"area\" \"color L\" [1 1 1] \"color scale\" [3 2 1]\n"
                                "LightSource \"infinite\" \"color L\" [1 2 3] \"string mapname\" \"\"");
    EXPECT_EQ(scene.lights.at(1).emission, glm::vec3(1, 2, 3));
    EXPECT_EQ(scene.lights.at(0).emission, glm::vec3(2, 2, 1.5f));
    EXPECT_EQ(scene.lights.at(0).scale, 1);
    EXPECT_EQ(scene.areaLights.at(0).radiance, glm::vec3(3, 2, 1));
}

TEST(OlderPbrt, texturesOfAnotherKindOrNoneAreTakenAsPbrtDid) {
    const std::string text =
        "Film \"image\" WorldBegin\n"
        "Texture \"mask\" \"color\" \"constant\" \"color value\" [.2 .3 .4]\n"
        "MakeNamedMaterial \"a\" \"string type\" \"matte\" \"texture Kd\" \"gone\"\n"
        "Material \"mix\" \"string namedmaterial1\" \"a\" \"string namedmaterial2\" \"a\"\n"
        "\"texture amount\" \"mask\"";
    const Scene scene = sceneOf(text);
    EXPECT_EQ(reflectanceOf(scene, 1).value, glm::vec3(0.5f));
    const auto mix = std::ranges::find(scene.materials, MaterialKind::mix, &Material::kind);
    ASSERT_NE(mix, scene.materials.end());
    EXPECT_EQ(scene.textures.at(std::size_t(mix->amount)).value.x, 0.2f);
    EXPECT_THAT(warningsOf(text),
                testing::IsSupersetOf(
                    {"s.pbrt:3:45: there is no spectrum texture 'gone'; 'reflectance' has its default",
                     "s.pbrt:5:1: the red of the spectrum texture 'mask' is taken for 'amount'"}));
}

TEST(OlderPbrt, attributesAndObjectsMayInterleave) {
    const Scene scene =
        sceneOf("Film \"image\" WorldBegin AttributeBegin ObjectBegin \"o\" Shape \"sphere\" AttributeEnd "
                "ObjectEnd ObjectInstance \"o\" WorldEnd");
    EXPECT_EQ(scene.objects.at(0).shapes.size(), 1u);
    EXPECT_EQ(scene.instances.size(), 1u);
}

TEST(OlderPbrt, instantsAreExposedForASecond) {
    const Scene scene =
        sceneOf("Camera \"perspective\" \"float shutteropen\" 0.25 \"float shutterclose\" 0.25\n"
                "WorldBegin ActiveTransform EndTime Translate 8 0 0 Shape \"sphere\"");
    EXPECT_EQ(scene.film.imagingRatio, 1);
    EXPECT_GT(scene.camera.shutterClose, scene.camera.shutterOpen);
    EXPECT_LT(scene.camera.shutterClose, 0.26f);
}

/// The double Gauss, once placed by the distance of its film, in millimetres from the front of the lens, and
/// once by its focus, in metres from the film.
TEST(OlderPbrt, camerasWithTheDistanceOfTheirFilmAreThoseWithAFocus) {
    const std::string lens = SLANT_SOURCE_DIR "/scenes/lenses/dgauss-50mm.dat";
    const auto cameraOf = [](const Scene& scene) {
        return CompoundLens(*scene.realistic, scene.camera.worldFromCamera, scene.film);
    };
    const CompoundLens focused = cameraOf(
        sceneOf("Film \"rgb\" \"integer xresolution\" 300 \"integer yresolution\" 200 \"float diagonal\" 40\n"
                "LookAt 1 2 3 4 2 8 0 1 0 Camera \"realistic\" \"string lensfile\" \"" +
                lens + "\" \"float aperturediameter\" 9 \"float focusdistance\" 0.8 WorldBegin"));
    const double filmDistance = -focused.filmZ(), toFront = focused.lens().frontVertex() + filmDistance;
    EXPECT_GT(filmDistance, 30);
    EXPECT_LT(filmDistance, 50);
    const CompoundLens placed = cameraOf(
        sceneOf(fmt::format("LookAt 1 2 3 4 2 8 0 1 0 Camera \"realistic\" \"string specfile\" \"{}\"\n"
                            "\"float filmdistance\" {} \"float aperture_diameter\" 9 \"float filmdiag\" 40 "
                            "\"float hither\" 0.001\n"
                            "\"float yon\" 1000 Film \"image\" \"integer xresolution\" 300 \"integer "
                            "yresolution\" 200 WorldBegin",
                            lens, filmDistance)));
    // Metres of the one are a thousand of the other, and its origin, the film, lies so far behind the front.
    const glm::dvec3 eye(1, 2, 3), forward = glm::normalize(glm::dvec3(3, 0, 5));
    for (int i = 0; i < 50; ++i) {
        const glm::vec2 raster(float(i * 37 % 300) + 0.5f, float(i * 71 % 200) + 0.5f);
        const glm::vec2 square(float(i) / 50, float(i * 13 % 50) / 50);
        const CameraSample a = focused.sample(raster, square), b = placed.sample(raster, square);
        const glm::dvec3 origin = eye + 1000.0 * (glm::dvec3(a.ray.origin) - eye) - toFront * forward;
        EXPECT_LT(glm::distance(glm::normalize(a.ray.direction), glm::normalize(b.ray.direction)), 1e-4f);
        const glm::dvec3 off = glm::dvec3(b.ray.origin) - origin, along(glm::normalize(b.ray.direction));
        EXPECT_LT(glm::length(off - glm::dot(off, along) * along), 1e-2) << "millimetres";
        EXPECT_NEAR(a.weight, b.weight, 1e-3f * a.weight);
    }
}

} // namespace
} // namespace slant

// All that is wrong with a scene is said at once; what is only not supported may have stand-ins.
#include "scene/issues.h"
#include "support/scene_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace slant {
namespace {

using test::errorOf;
using testing::EndsWith;
using testing::HasSubstr;

TEST(SceneIssues, areAllListed) {
    const std::string text = "Integrator \"path\" \"integer maxdpth\" 1\n"
                             "Film \"rgb\" \"integer xresolution\" 0\n"
                             "WorldBegin\n"
                             "Material \"hair\" \"rgb sigma_a\" [1 2 3]\n"
                             "Texture \"t\" \"float\" \"ptex\" \"string filename\" \"a\"\n"
                             "Attribute \"shapes\" \"float radius\" [1 2]\n"
                             "Shape \"sphere\" \"float raduis\" 1 \"float hight\" 1\n"
                             "Shape \"curve\" \"point3 P\" [1 2 3] Shape \"curve\"\n"
                             "NamedMaterial \"none\"\n"
                             "Include \"none.pbrt\"\n";
    const std::string upToEnd =
        "s.pbrt:1:19: Integrator \"path\" has no parameter 'maxdpth', or none that is supported, did you "
        "mean 'maxdepth'?\n"
        "s.pbrt:2:12: 'xresolution' is 0, but must be at least 1 and at most 1048576\n"
        "s.pbrt:4:1: material \"hair\" is not supported: a sample has one depth, and strands thinner than a "
        "pixel have many\n"
        "s.pbrt:5:1: texture kind \"ptex\" is not supported\n"
        "s.pbrt:6:11: unknown attribute target \"shapes\", did you mean 'shape'?\n"
        "s.pbrt:7:16: Shape \"sphere\" has no parameter 'raduis', or none that is supported, did you mean "
        "'radius'?\n"
        "s.pbrt:7:33: Shape \"sphere\" has no parameter 'hight', or none that is supported\n"
        "s.pbrt:8:1: curves are not supported: a sample has one depth, and strands thinner than a pixel have "
        "many (2 times)\n"
        "s.pbrt:9:1: there is no material 'none'\n"
        "s.pbrt:10:9: none.pbrt: there is no such file";
    EXPECT_EQ(errorOf(text), upToEnd);
    // Unreadable text ends the reading: textures and materials are not looked at.
    const std::string unreadable = errorOf(text + "Shape \"sphere\" \"float radius\" [1\n");
    EXPECT_THAT(unreadable, EndsWith("s.pbrt:11:31: this '[' is never closed"));
    EXPECT_THAT(unreadable, HasSubstr("strands thinner than a pixel have many (2 times)\n"));
    std::string many = "WorldBegin\n";
    for (int i = 0; i < 30; ++i) many += fmt::format("LightSource \"l{}\"\n", i);
    EXPECT_THAT(errorOf(many),
                EndsWith(":21:1: light \"l19\" is not supported\nand 10 more; slant check lists "
                         "all"));
    for (int i = 30; i < 1100; ++i) many += fmt::format("LightSource \"l{}\"\n", i);
    EXPECT_THAT(errorOf(many), EndsWith("and 981 more; slant check lists all"));
}

TEST(SceneIssues, leniencyPutsStandIns) {
    const auto read = [](const std::string& text) {
        test::RecordingMonitor monitor;
        const Scene scene = readSceneText(text, "s.pbrt", monitor, {.lenient = true});
        return std::pair(scene, monitor.warnings);
    };
    const auto [scene, warnings] =
        read("Film \"sepia\" Sampler \"mlt\" PixelFilter \"lanczos\" Integrator \"guided\"\n"
             "WorldBegin MakeNamedMedium \"fog\"\n"
             "Material \"silk\" LightSource \"laser\" AreaLightSource \"beam\"\n"
             "Shape \"sphere\" \"float thickness\" 1 Shape \"fur\" Shape \"fur\"\n"
             "Texture \"t\" \"float\" \"ptex\"\n");
    using testing::ElementsAre;
    EXPECT_THAT(
        warnings,
        ElementsAre(
            "s.pbrt:1:1: film \"sepia\" is not supported; the film is \"rgb\" of 1280x720",
            "s.pbrt:1:14: sampler \"mlt\" is not supported; 16 samples are taken of a pixel",
            "s.pbrt:1:28: pixel filter \"lanczos\" is not supported; the filter is \"gaussian\"",
            "s.pbrt:1:50: integrator \"guided\" is not supported; the integrator is \"path\"",
            "s.pbrt:2:12: participating media are not supported; it is left out",
            "s.pbrt:3:1: material \"silk\" is not supported; grey stands in, diffuse with a reflectance of "
            "0.5",
            "s.pbrt:3:17: light \"laser\" is not supported; it is left out",
            "s.pbrt:3:37: area light \"beam\" is not supported; it is left out",
            "s.pbrt:4:16: Shape \"sphere\" has no parameter 'thickness', or none that is supported; it is "
            "ignored",
            "s.pbrt:4:36: shape \"fur\" is not supported; it is left out (2 times)",
            "s.pbrt:5:1: texture kind \"ptex\" is not supported; a constant of 0.5 stands in"));
    ASSERT_EQ(scene.shapes.size(), 1u);
    EXPECT_EQ(scene.shapes[0].areaLightIndex, -1);
    EXPECT_TRUE(scene.lights.empty());
    const Material& grey = scene.materials.at(std::size_t(scene.shapes[0].materialIndex));
    EXPECT_EQ(scene.textures.at(std::size_t(grey.reflectance)).value, glm::vec3(0.5f));

    // What is wrong stays wrong, and without its camera there is no picture.
    EXPECT_THROW(read("WorldBegin Shape \"sphere\" \"float radius\" -1"), InvalidScene);
    EXPECT_THROW(read("Camera \"fisheye\" WorldBegin"), InvalidScene);
    EXPECT_THROW(read("WorldBegin Shape \"sphere\" \"float radius\" x"), InvalidScene);
}

TEST(SceneIssues, leniencyKnowsNearMaterials) {
    const std::string text =
        "WorldBegin Material \"measured\" \"string filename\" \"a.bsdf\" Shape \"disk\"\n"
        "Material \"subsurface\" \"float eta\" 1.4 Shape \"disk\"\n"
        "Material \"subsurface\" \"rgb reflectance\" [.1 .2 .3] Shape \"disk\"\n"
        "Material \"fourier\" \"string bsdffile\" \"b.bsdf\" Shape \"disk\"\n"
        "Material \"kdsubsurface\" \"rgb Kd\" [.3 .2 .1] Shape \"disk\"\n";
    EXPECT_THAT(errorOf(text), HasSubstr("s.pbrt:1:12: material \"measured\" is not supported\n"));
    test::RecordingMonitor monitor;
    const Scene scene = readSceneText(text, "s.pbrt", monitor, {.lenient = true});
    EXPECT_THAT(
        monitor.warnings,
        testing::IsSupersetOf(
            {"s.pbrt:1:12: material \"measured\" is not supported; a grey, coated, rough diffuse material "
             "stands in",
             "s.pbrt:2:1: material \"subsurface\" is not supported; \"coateddiffuse\" stands in (3 times)",
             "s.pbrt:4:1: material \"fourier\" is not supported; a grey, coated, rough diffuse material "
             "stands in"}));
    ASSERT_EQ(scene.shapes.size(), 5u);
    const auto materialOf = [&](std::size_t shape) {
        return scene.materials.at(std::size_t(scene.shapes[shape].materialIndex));
    };
    const auto reflectanceOf = [&](std::size_t shape) {
        return scene.textures.at(std::size_t(materialOf(shape).reflectance)).value;
    };
    for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(materialOf(i).kind, MaterialKind::coatedDiffuse);
    EXPECT_EQ(reflectanceOf(0), glm::vec3(0.5f));
    EXPECT_EQ(materialOf(1).interfaceEta, 1.4f);
    EXPECT_GT(reflectanceOf(1).x, 0.9f) << "milk is white";
    EXPECT_GT(reflectanceOf(1).x, reflectanceOf(1).z) << "and a little yellow";
    EXPECT_EQ(reflectanceOf(2), glm::vec3(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(reflectanceOf(4), glm::vec3(0.3f, 0.2f, 0.1f));
}

} // namespace
} // namespace slant

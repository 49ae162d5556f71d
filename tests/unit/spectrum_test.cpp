// Spectra and colour spaces as Rec.709.
#include "scene/colour_space.h"
#include "scene/spectra.h"
#include "support/scene_text.h"
#include "support/temp_dir.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace slant {
namespace {

using test::sceneOf;
using test::worldOf;

void expectNear(glm::vec3 a, glm::vec3 b, float bound) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], bound) << c;
}

glm::vec3 reflectanceOf(const Scene& scene, std::size_t material = 1) {
    return scene.textures.at(std::size_t(scene.materials.at(material).reflectance)).value;
}

TEST(SampledSpectrum, hasStraightLinesAndNothingOutside) {
    const SampledSpectrum spectrum({400, 1, 500, 3, 700, 2});
    EXPECT_EQ(spectrum.at(399), 0);
    EXPECT_EQ(spectrum.at(400), 1);
    EXPECT_DOUBLE_EQ(spectrum.at(450), 2);
    EXPECT_DOUBLE_EQ(spectrum.at(600), 2.5);
    EXPECT_EQ(spectrum.at(700), 2);
    EXPECT_EQ(spectrum.at(701), 0);
    EXPECT_FALSE(spectrum.isConstant());
    EXPECT_TRUE(SampledSpectrum({300, 2, 900, 2}).isConstant());
    EXPECT_FALSE(SampledSpectrum({400, 2, 900, 2}).isConstant());
}

TEST(SampledSpectrum, constantReflectanceIsGrey) {
    expectNear(reflectanceRgb([](double) { return 0.3; }), glm::vec3(0.3f), 1e-6f);
}

/// A red and a green surface; what the tables of CIE 1931 make of them under D65.
TEST(SampledSpectrum, reflectanceFollowsTheStandardObserver) {
    // Measured: within 0.006, and 0.004 over the 24 patches of a ColorChecker.
    const SampledSpectrum step({360, 0, 580, 0, 620, 0.8, 830, 0.8});
    expectNear(reflectanceRgb([&](double nm) { return step.at(nm); }), {0.6724f, -0.0202f, -0.0111f}, 0.007f);
    const auto green = [](double nm) { return 0.1 + 0.6 * std::exp(-std::pow((nm - 530) / 40, 2)); };
    expectNear(reflectanceRgb(green), {-0.0410f, 0.5623f, 0.1130f}, 0.007f);
}

TEST(SampledSpectrum, equalEnergyIsItsChromaticity) {
    // x = y = 1/3 has XYZ 1, 1, 1 and Rec.709 1.2048, 0.9483, 0.9089.
    expectNear(lightRgb([](double) { return 7.0; }), {1.2048f, 0.9483f, 0.9089f}, 0.01f);
    expectNear(lightRgb([](double) { return 0.0; }), glm::vec3(0), 0);
}

TEST(SampledSpectrum, illuminantsAreWhiteAtTheirOwnTemperature) {
    expectNear(whiteBalance(daylight(5000)) * lightRgb([](double nm) { return blackbody(nm, 5000); }),
               glm::vec3(1), 0.06f); // daylight lies a little beside black bodies
    const glm::dvec2 d65 = daylight(6504);
    EXPECT_NEAR(d65.x, 0.3127, 1e-4);
    EXPECT_NEAR(d65.y, 0.3291, 1e-4);
    const glm::dvec2 a = illuminantWhite(2856);
    EXPECT_NEAR(a.x, 0.4476, 2e-3); // CIE A is a black body
    EXPECT_NEAR(a.y, 0.4074, 2e-3);
}

TEST(SampledSpectrum, metalsKeepTheirReflectance) {
    // Where eta and k do not vary, they are found again.
    const Metal metal = metalOf([](double) { return 0.5; }, [](double) { return 3.0; });
    for (int c = 0; c < 3; ++c)
        for (const double cosine : {1.0, 0.7, 0.3, 0.05})
            EXPECT_NEAR(fresnelReflectance(cosine, double(metal.eta[c]), double(metal.k[c])),
                        fresnelReflectance(cosine, 0.5, 3), 1e-4);
    EXPECT_NEAR(fresnelReflectance(1, 1.5, 0), 0.04, 1e-12);
    // Copper, measured at a few wavelengths (Johnson and Christy 1972), against what its name stands for.
    const SampledSpectrum eta(
        {360, 1.27, 400, 1.18, 450, 1.15, 500, 1.13, 550, 1.02, 600, .4, 650, .214, 830, .25}),
        k({360, 1.95, 400, 2.21, 450, 2.4, 500, 2.56, 550, 2.58, 600, 2.94, 650, 3.67, 830, 5.2});
    const Metal copper = metalOf([&](double nm) { return eta.at(nm); }, [&](double nm) { return k.at(nm); });
    const glm::vec3 named = *metalSpectrum("metal-Cu-eta"), namedK = *metalSpectrum("metal-Cu-k");
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(fresnelReflectance(1, double(copper.eta[c]), double(copper.k[c])),
                    fresnelReflectance(1, double(named[c]), double(namedK[c])), 0.03);
}

TEST(Spectra, ofParameters) {
    const Scene scene = worldOf("Material \"diffuse\" \"spectrum reflectance\" [300 .4 900 .4]\n"
                                "LightSource \"infinite\" \"spectrum L\" [300 8 900 8]\n"
                                "LightSource \"infinite\" \"spectrum L\" \"stdillum-A\"\n"
                                "Material \"diffuse\" \"xyz reflectance\" [.4 .42 .46]");
    EXPECT_EQ(reflectanceOf(scene), glm::vec3(0.4f));
    expectNear(scene.lights.at(0).emission, {1.2048f, 0.9483f, 0.9089f}, 0.01f); // of luminance 1
    const glm::vec3 a = scene.lights.at(1).emission;
    EXPECT_NEAR(0.2126f * a.r + 0.7152f * a.g + 0.0722f * a.b, 1, 0.01f);
    EXPECT_GT(a.r, 1.8f);
    expectNear(reflectanceOf(scene, 2), {0.4213f, 0.4193f, 0.4229f}, 1e-4f);
}

TEST(Spectra, ofFiles) {
    const test::TempDir dir;
    test::writeText(dir.file("s.spd"), "# nm, value\n300 .25\n900 .25\n");
    SilentMonitor monitor;
    const Scene scene = readSceneText("WorldBegin Material \"diffuse\" \"spectrum reflectance\" \"s.spd\"",
                                      dir.file("s.pbrt"), monitor);
    EXPECT_EQ(reflectanceOf(scene), glm::vec3(0.25f));
}

TEST(ColourSpace, whiteStaysWhite) {
    for (const char* name : {"srgb", "REC2020", "dci-p3", "aces2065-1"}) {
        const ColourSpace* space = colourSpaceOf(name);
        ASSERT_TRUE(space) << name;
        expectNear(rec709Reflectance(*space, glm::vec3(0.7f)), glm::vec3(0.7f), 1e-3f);
    }
    EXPECT_FALSE(colourSpaceOf("adobe"));
    // ITU-R BT.2087: Rec.2020 to Rec.709.
    expectNear(rec709Light(*colourSpaceOf("rec2020"), {1, 0, 0}), {1.6605f, -0.1246f, -0.0182f}, 1e-3f);
    // The white of ACES is warmer than D65.
    const glm::vec3 warm = rec709Light(*colourSpaceOf("aces2065-1"), glm::vec3(1));
    EXPECT_GT(warm.r, 1.03f);
    EXPECT_LT(warm.b, 0.95f);
}

TEST(ColourSpace, holdsWhereItStands) {
    const Scene scene = worldOf("AttributeBegin ColorSpace \"rec2020\"\n"
                                "Material \"diffuse\" \"rgb reflectance\" [.6 .3 .2] AttributeEnd\n"
                                "Material \"diffuse\" \"rgb reflectance\" [.6 .3 .2]");
    expectNear(reflectanceOf(scene, 1), rec709Reflectance(*colourSpaceOf("rec2020"), {.6f, .3f, .2f}), 1e-6f);
    EXPECT_EQ(reflectanceOf(scene, 2), glm::vec3(.6f, .3f, .2f));
    EXPECT_GT(reflectanceOf(scene, 1).r, .7f);
}

TEST(WhiteBalance, makesItsIlluminantWhite) {
    const Scene scene = sceneOf(
        "Film \"rgb\" \"float whitebalance\" 3000 WorldBegin LightSource \"infinite\" \"blackbody L\" 3000");
    expectNear(scene.film.whiteBalance * scene.lights.at(0).emission, glm::vec3(1), 0.02f);
    EXPECT_EQ(sceneOf("Film \"rgb\" WorldBegin").film.whiteBalance, glm::mat3(1));
    test::RecordingMonitor monitor;
    const Scene canon =
        readSceneText("Film \"gbuffer\" \"string sensor\" \"canon_eos_5d\" WorldBegin", "s.pbrt", monitor);
    expectNear(canon.film.whiteBalance * glm::vec3(1), glm::vec3(1), 0.01f); // 6500 K
    EXPECT_THAT(
        monitor.warnings,
        testing::ElementsAre("s.pbrt:1:1: film \"gbuffer\" is read as \"rgb\"",
                             "s.pbrt:1:16: sensor \"canon_eos_5d\" is read as \"cie1931\" with its white "
                             "balance"));
}

} // namespace
} // namespace slant

// slant lens: figures, residuals and drawing.
#include "support/run_program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace slant {
namespace {

using testing::HasSubstr;

const std::string kScenes = SLANT_SOURCE_DIR "/scenes/";

TEST(LensCommand, describesALensFile) {
    const test::TempDir dir;
    const test::ProgramResult run =
        test::runSlant({"lens", kScenes + "lenses/dgauss-50mm.dat", "--svg", dir.file("lens.svg")});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.err, "");
    EXPECT_THAT(run.out, HasSubstr("focal length    50.358 mm"));
    EXPECT_THAT(run.out, HasSubstr("f-number        2.80"));
    EXPECT_THAT(run.out, HasSubstr("A tolerance of 0.25 px selects: film radius"));
    const std::string svg = test::readText(dir.file("lens.svg"));
    EXPECT_THAT(svg, testing::StartsWith("<svg "));
    EXPECT_THAT(svg, testing::EndsWith("</svg>\n"));
    EXPECT_THAT(svg, testing::Not(HasSubstr("nan")));
    const auto count = [&](const std::string& text) {
        std::size_t n = 0;
        for (std::size_t at = svg.find(text); at != std::string::npos; at = svg.find(text, at + 1)) ++n;
        return n;
    };
    EXPECT_EQ(count("fill=\"#d5e6f3\""), 6u) << "glasses";
    EXPECT_EQ(count("stroke=\"#c0392b\""), 9u) << "rays to the middle";
    EXPECT_EQ(count("stroke=\"#2471a3\""), 9u) << "rays to the edge";
}

TEST(LensCommand, takesTheCameraOfAScene) {
    const test::ProgramResult run = test::runSlant({"lens", kScenes + "row-telephoto.pbrt"});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_THAT(run.out, HasSubstr("focus           1.8 m from the film"));
    EXPECT_THAT(run.out, HasSubstr("36.00 mm across"));
}

TEST(LensCommand, fieldsOfALensKnowItsFigures) {
    const test::TempDir dir;
    const std::string scene = kScenes + "row-dgauss.pbrt", field = dir.file("field.exr");
    EXPECT_EQ(
        test::runSlant({"sample", scene, "--crop", "240,242,130,132", "--spp", "1", "-o", field}).status, 0);
    const std::string info = test::runSlant({"info", field}).out, lens = test::runSlant({"lens", scene}).out;
    const auto figure = [](const std::string& text, const std::string& name) {
        const std::size_t at = text.find(name);
        EXPECT_NE(at, std::string::npos) << name << " in " << text;
        return at == std::string::npos ? 0 : std::stod(text.substr(at + name.size()));
    };
    EXPECT_NEAR(figure(info, "f-number"), figure(lens, "f-number"), 0.006);
    EXPECT_NEAR(figure(info, "focal length") * 1000, figure(lens, "focal length"), 0.001);
}

TEST(LensCommand, anAlmostClosedLensNeedsTwoConstants) {
    const test::ProgramResult run = test::runSlant(
        {"lens", kScenes + "lenses/telephoto-250mm.dat", "--aperture", "4", "--focus-distance", "20"});
    EXPECT_THAT(run.out, HasSubstr("selects: lens\n"));
}

TEST(LensCommand, refusesWhatItCannotDescribe) {
    const auto expect = [](std::vector<std::string> words, int status, const std::string& message) {
        words.insert(words.begin(), "lens");
        const test::ProgramResult run = test::runSlant(words);
        EXPECT_EQ(run.status, status) << run.err;
        EXPECT_EQ(run.errorLines(), 1) << run.err;
        EXPECT_THAT(run.err, HasSubstr(message));
    };
    const std::string lens = kScenes + "lenses/wide-22mm.dat";
    expect({"/no/lens.dat"}, 3, "/no/lens.dat");
    expect({kScenes + "row.pbrt"}, 3, "is not \"realistic\"");
    expect({kScenes + "meshes/dragon.ply"}, 3, "expected a number, found 'ply'");
    expect({lens, "--focus-distance", "0.05"}, 3, "cannot focus at 50 mm from the film: the nearest is 98.");
    expect({lens, "--aperture", "0"}, 2, "--aperture");
    expect({lens, "--svg", "/no/folder/a.svg"}, 5, "/no/folder/a.svg");
    expect({kScenes + "row-wide.pbrt", "--aperture", "3"}, 2, "are for lens files");
    expect({}, 2, "FILE is required");
}

} // namespace
} // namespace slant

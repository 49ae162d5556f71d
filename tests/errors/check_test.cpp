// slant check, and --lenient, end to end.
#include "support/run_program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace slant {
namespace {

using test::runSlant;
using testing::HasSubstr;

class Check : public testing::Test {
protected:
    void SetUp() override {
        test::writeText(scene, "Film \"rgb\" \"integer xresolution\" 4 \"integer yresolution\" 3\n"
                               "WorldBegin\n"
                               "Material \"hair\" Shape \"curve\" Shape \"curve\" Shape \"sphere\"\n"
                               "LightSource \"infinite\"\n");
        test::writeText(wrong, "WorldBegin Shape \"curve\" Shape \"sphere\" \"float radius\" -1\n");
        test::writeText(fine, "WorldBegin TransformBegin TransformEnd\n");
    }

    test::TempDir dir;
    const std::string scene = dir.file("s.pbrt"), wrong = dir.file("w.pbrt"), fine = dir.file("f.pbrt");
};

TEST_F(Check, listsAllThatIsNotSupported) {
    const test::ProgramResult result = runSlant({"check", scene});
    EXPECT_EQ(result.status, 3);
    const std::string why = ": a sample has one depth, and strands thinner than a pixel have many";
    EXPECT_EQ(result.out, scene + ":3:1: material \"hair\" is not supported" + why + "\n" + scene +
                              ":3:17: curves are not supported" + why + " (2 times)\n");
    EXPECT_EQ(result.err, "slant: error: " + scene + ": 2 not supported, 0 wrong\n");
    const test::ProgramResult accepted = runSlant({"check", fine});
    EXPECT_EQ(accepted.status, 0);
    EXPECT_THAT(accepted.out, testing::EndsWith("f.pbrt: accepted\n"));
    EXPECT_THAT(accepted.out, HasSubstr("warning: "));
}

TEST_F(Check, speaksJson) {
    const test::ProgramResult result = runSlant({"check", "--json", wrong});
    EXPECT_EQ(result.status, 3);
    const nlohmann::json json = nlohmann::json::parse(result.out);
    EXPECT_EQ(json.at("accepted"), false);
    ASSERT_EQ(json.at("issues").size(), 2u);
    EXPECT_EQ(json["issues"][0]["unsupported"], true);
    const nlohmann::json& second = json["issues"][1];
    EXPECT_EQ(second.at("file"), wrong);
    EXPECT_EQ(second.at("line"), 1);
    EXPECT_EQ(second.at("column"), 41);
    EXPECT_EQ(second.at("message"), "'radius' is -1, but must be above 0");
    EXPECT_EQ(second.at("unsupported"), false);
    EXPECT_EQ(second.at("count"), 1);
    EXPECT_EQ(nlohmann::json::parse(runSlant({"check", "--json", fine}).out).at("warnings").size(), 1u);
}

TEST_F(Check, commandsRefuseOrAreLenient) {
    for (const std::vector<std::string>& command : std::vector<std::vector<std::string>>{
             {"check"},
             {"reference", "-o", dir.file("r.exr"), "--spp", "1"},
             {"render", "-o", dir.file("p.exr"), "--spp", "1", "--device", "cpu"},
             {"sample", "-o", dir.file("f.exr"), "--spp", "1"}}) {
        std::vector<std::string> words = command;
        words.push_back(scene);
        words.push_back(command[0] == "check" ? "--json" : "--quiet");
        const test::ProgramResult strict = runSlant(words);
        EXPECT_EQ(strict.status, 3) << command[0];
        EXPECT_EQ(strict.errorLines(), command[0] == "check" ? 1 : 2) << strict.err;
        words.push_back("--lenient");
        const test::ProgramResult lenient = runSlant(words);
        EXPECT_EQ(lenient.status, 0) << command[0] << lenient.err;
        EXPECT_THAT(lenient.out + lenient.err, HasSubstr("it is left out (2 times)")) << command[0];
    }
    EXPECT_EQ(runSlant({"check", "--lenient", wrong}).status, 3);
    EXPECT_EQ(runSlant({"check", dir.file("none.pbrt")}).status, 3);
}

} // namespace
} // namespace slant

// slant chart from end to end, on a scene of a few pixels.
#include "support/run_program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace slant {
namespace {

using testing::HasSubstr;

TEST(Chart, writesAllItsFilesAndResumes) {
    const test::TempDir dir;
    const std::string scene = dir.file("tiny.pbrt"), out = dir.file("deep/out");
    test::writeText(scene, "Film \"rgb\" \"integer xresolution\" 16 \"integer yresolution\" 9\n"
                           "Translate 0 0 4 Camera \"perspective\" \"float fov\" 40\n"
                           "\"float lensradius\" 0.2 \"float focaldistance\" 3\n"
                           "WorldBegin LightSource \"distant\" Shape \"sphere\"\n");
    const std::vector<std::string> words = {"chart",       scene,        "-o",        out,
                                            "--spp",       "2",          "--outputs", "8",
                                            "--truth-spp", "64",         "--cache",   dir.file("cache"),
                                            "--repeat",    "1",          "--quiet",   "--devices",
                                            "cpu",         "--adaptive", "0.5"};
    const test::ProgramResult first = test::runSlant(words);
    ASSERT_EQ(first.status, 0) << first.err;
    EXPECT_EQ(first.err, "");
    EXPECT_THAT(first.out, testing::EndsWith("index.html\n"));
    const auto text = [&](const std::string& name) { return test::readText(out + "/" + name); };
    EXPECT_THAT(text("tiny.svg"), HasSubstr("relMSE"));
    EXPECT_THAT(text("tiny-flip.svg"), HasSubstr("FLIP"));
    EXPECT_THAT(text("results.csv"), HasSubstr("\ntiny,reference,16,0,cpu,"));
    EXPECT_THAT(text("results.csv"), HasSubstr("\ntiny,auto adaptive,2,8,cpu,"));
    EXPECT_THAT(text("index.html"), HasSubstr("--truth-spp 64"));
    EXPECT_THAT(text("index.html"), HasSubstr("data:image/png;base64,iVBORw0KGgo"));
    const auto json = nlohmann::json::parse(text("results.json"));
    EXPECT_GE(json["points"].size(), 8u);

    const auto csv = text("results.csv");
    ASSERT_EQ(test::runSlant(words).status, 0);
    EXPECT_EQ(text("results.csv"), csv) << "times of another run";
    auto fresh = words;
    fresh.push_back("--fresh");
    ASSERT_EQ(test::runSlant(fresh).status, 0);
    EXPECT_NE(text("results.csv"), csv) << "the same times to six digits";
}

} // namespace
} // namespace slant

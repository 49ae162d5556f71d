// Command lines by chance: options of any command, with values that fit or do not, in any order. The program
// ends with a documented status and says why in one line.
#include "support/run_program.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>

namespace slant {
namespace {

TEST(CommandMutations, endWithADocumentedStatus) {
    const test::TempDir dir;
    const std::string scene = dir.file("s.pbrt"), out = dir.file("out.exr");
    test::writeText(
        scene, "Film \"rgb\" \"integer xresolution\" 3 \"integer yresolution\" 2 \"string filename\" \"" +
                   out + "\" Camera \"perspective\" WorldBegin Shape \"sphere\"");
    const std::vector<std::string> words = {"render",      "reference",  "sample",
                                            "reconstruct", "info",       "diff",
                                            "check",       "lens",       "devices",
                                            "--spp",       "--seed",     "--crop",
                                            "--out-spp",   "--method",   "--device",
                                            "--memory",    "--threads",  "--quiet",
                                            "--auxiliary", "--float",    "--exposure",
                                            "--shutter",   "--freeze",   "--focus-from",
                                            "--frames",    "--aperture", "--f-stop",
                                            "--pinhole",   "--max-mse",  "--json",
                                            "--lenient",   "--help",     "--window-range",
                                            "-o",          "--",         "1",
                                            "2",           "-1",         "0",
                                            "1e999",       "nan",        "99999999999999999999",
                                            "0,1,0,1",     "cpu",        "full",
                                            "box",         "16M",        "",
                                            "\xff\xfe",    "polygon 99", "%n%s",
                                            "--spp=2",     "--crop=0,2", "auto",
                                            scene,         out};
    std::mt19937 random{5};
    std::vector<int> statuses(6);
    for (int run = 0; run < 150; ++run) {
        std::vector<std::string> line = {words[random() % 9]};
        if (random() % 4 != 0) line.push_back(scene);
        if (random() % 3 == 0) line.insert(line.end(), {"-o", out, "--device", "cpu"});
        for (std::size_t more = random() % 4; more > 0; --more)
            line.push_back(words[9 + random() % (words.size() - 9)]);
        const test::ProgramResult result = test::runSlant(line);
        ASSERT_THAT(result.status, testing::AllOf(testing::Ge(0), testing::Le(5)))
            << testing::PrintToString(line) << result.err;
        ++statuses[std::size_t(result.status)];
        if (result.status < 2) continue;
        EXPECT_EQ(result.errorLines(), 1) << testing::PrintToString(line) << result.err;
        EXPECT_THAT(result.err, testing::StartsWith("slant: error: "));
    }
    EXPECT_GT(statuses[0], 5);
    EXPECT_GT(statuses[2], 20);
}

} // namespace
} // namespace slant

// slant chart when something is wrong: the exit status and one line, before any work is done.
#include "support/run_program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace slant {
namespace {

using test::ProgramResult;
using test::runSlant;
using testing::HasSubstr;

constexpr const char* kSpheres = SLANT_SOURCE_DIR "/scenes/spheres.pbrt";

class ChartErrors : public testing::Test {
protected:
    std::vector<std::string> job(std::vector<std::string> words) const {
        words.insert(words.begin(), "chart");
        words.insert(words.end(), {"--quiet", "--cache", dir_.file("cache")});
        return words;
    }
    /// Runs slant chart quietly; expects the status and one line.
    ProgramResult fails(int status, const std::vector<std::string>& words) const {
        const ProgramResult result = runSlant(job(words));
        EXPECT_EQ(result.status, status) << testing::PrintToString(words) << result.err;
        EXPECT_EQ(result.errorLines(), 1) << result.err;
        EXPECT_THAT(result.err, testing::StartsWith("slant: error: "));
        EXPECT_EQ(result.out, "");
        return result;
    }

    test::TempDir dir_;
    const std::string out_ = dir_.file("out");
};

TEST_F(ChartErrors, wrongListsGiveStatusTwo) {
    const std::vector<std::array<std::string, 3>> wrong = {
        {"--spp", "", "list"},          {"--spp", "8,", "list"},         {"--spp", "8,8", "twice"},
        {"--spp", "0", "from 1"},       {"--spp", "8;4", "from 1"},      {"--outputs", "100", "power of two"},
        {"--methods", "ful", "'full'"}, {"--methods", ",box", "list"},   {"--devices", "cpu,,auto", "list"},
        {"--repeat", "0", "--repeat"},  {"--truth-spp", "63", "from 64"}};
    for (const auto& [option, value, says] : wrong)
        EXPECT_THAT(fails(2, {kSpheres, "-o", out_, option, value}).err, HasSubstr(says)) << option << value;
    fails(2, {"-o", out_});
    fails(2, {kSpheres});
    EXPECT_THAT(fails(2, {kSpheres, kSpheres, "-o", out_}).err, HasSubstr("two scenes are called 'spheres'"));
}

TEST_F(ChartErrors, missingScenesGiveStatusThree) {
    EXPECT_THAT(fails(3, {kSpheres, dir_.file("none.pbrt"), "-o", out_}).err, HasSubstr("none.pbrt"));
    test::writeText(dir_.file("results.json"), "{\"points\": 3}");
    EXPECT_THAT(fails(3, {kSpheres, "-o", dir_.path().string()}).err, HasSubstr("results.json"));
}

TEST_F(ChartErrors, unknownDevicesGiveStatusFour) {
    EXPECT_THAT(fails(4, {kSpheres, "-o", out_, "--devices", "cpu,nosuch"}).err, HasSubstr("nosuch"));
}

TEST_F(ChartErrors, unwritablePlacesGiveStatusFive) {
    test::writeText(dir_.file("file"), "");
    EXPECT_THAT(fails(5, {kSpheres, "-o", dir_.file("file")}).err, HasSubstr("file"));
    EXPECT_THAT(fails(5, {kSpheres, "-o", "/proc/none"}).err, HasSubstr("/proc/none"));
    const ProgramResult noCache = runSlant({"chart", kSpheres, "-o", out_, "--cache", "/proc/none"});
    EXPECT_EQ(noCache.status, 5) << noCache.err;
}

TEST_F(ChartErrors, missingGnuplotGivesStatusFiveAndLeavesNothing) {
    std::vector<std::string> words = {"env", "PATH=" + dir_.path().string(), SLANT_PROGRAM};
    for (const std::string& word : job({kSpheres, "-o", out_})) words.push_back(word);
    const ProgramResult result = test::runWords(words);
    EXPECT_EQ(result.status, 5) << result.err;
    EXPECT_EQ(result.errorLines(), 1) << result.err;
    EXPECT_THAT(result.err, HasSubstr("gnuplot"));
    EXPECT_EQ(dir_.entries(), 0u);
}

TEST_F(ChartErrors, interruptionLeavesNoHalfFile) {
    const std::string scene = dir_.file("tiny.pbrt");
    test::writeText(scene, "Film \"rgb\" \"integer xresolution\" 128 \"integer yresolution\" 128\n"
                           "WorldBegin LightSource \"distant\" Translate 0 0 5 Shape \"sphere\"\n");
    // A thousand runs of each point take minutes.
    std::vector<std::string> words = {SLANT_PROGRAM};
    for (const std::string& word :
         job({scene, "-o", out_, "--devices", "cpu", "--spp", "1", "--truth-spp", "64", "--repeat", "1000"}))
        words.push_back(word);
    const ProgramResult result = test::runAndInterrupt(words);
    EXPECT_EQ(result.status, 130) << result.err;
    EXPECT_EQ(result.errorLines(), 1) << result.err;
    std::error_code none; // interrupted before there is any output
    for (const auto& entry : std::filesystem::directory_iterator(out_, none))
        EXPECT_THAT(entry.path().filename().string(), testing::AnyOf("images", "results.json"));
}

} // namespace
} // namespace slant

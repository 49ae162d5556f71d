// slant render and slant reference when something is wrong: the exit status, one line, and no file left.
#include "support/run_program.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace slant {
namespace {

using test::ProgramResult;
using test::runSlant;
using test::TempDir;
using testing::HasSubstr;

constexpr const char* kSpheres = SLANT_SOURCE_DIR "/scenes/spheres.pbrt";

class RenderErrors : public testing::Test {
protected:
    /// Runs slant quietly; expects the status and one line.
    ProgramResult fails(int status, std::vector<std::string> words) const {
        words.insert(words.end(), {"--quiet", "--threads", "2"});
        const ProgramResult result = runSlant(words);
        EXPECT_EQ(result.status, status) << testing::PrintToString(words) << result.err;
        EXPECT_EQ(result.errorLines(), 1) << result.err;
        EXPECT_THAT(result.err, testing::StartsWith("slant: error: "));
        EXPECT_EQ(result.out, "");
        return result;
    }
    ProgramResult renderFails(int status, const std::string& scene, std::vector<std::string> words) const {
        words.insert(words.begin(), {"render", scene});
        return fails(status, words);
    }
    /// A scene with nothing in it, of that film.
    std::string emptyScene(int width, int height) const {
        const std::string path = inputs_.file("empty.pbrt");
        test::writeText(path,
                        fmt::format("Film \"rgb\" \"integer xresolution\" {} \"integer yresolution\" {}\n"
                                    "Camera \"perspective\"\nWorldBegin\n",
                                    width, height));
        return path;
    }

    TempDir dir_, inputs_;
    const std::string output_ = dir_.file("out.exr");
};

TEST_F(RenderErrors, unreadableScenesGiveStatusThree) {
    const std::string garbage = inputs_.file("garbage.pbrt");
    std::string bytes;
    for (unsigned i = 0; i < 5000; ++i) bytes += char(i * 2654435761u >> 24);
    test::writeText(garbage, bytes);
    for (const std::string& scene : {inputs_.file("none.pbrt"), inputs_.path().string(), garbage}) {
        EXPECT_THAT(fails(3, {"reference", scene, "-o", output_}).err, HasSubstr(scene));
        EXPECT_THAT(renderFails(3, scene, {"--device", "cpu", "-o", output_}).err, HasSubstr(scene));
    }
    EXPECT_EQ(dir_.entries(), 0u);
}

TEST_F(RenderErrors, wrongOptionsGiveStatusTwoBeforeTheSceneIsRead) {
    const std::string none = inputs_.file("none.pbrt");
    EXPECT_THAT(renderFails(2, none, {"--out-spp", "100"}).err, HasSubstr("power of two"));
    for (const char* count : {"0", "-8", "3", "8192", "4294967296", "8x", ""})
        EXPECT_THAT(renderFails(2, none, {"--out-spp", count}).err, HasSubstr("--out-spp"));
    renderFails(2, none, {"--spp", "0"});
    renderFails(2, none, {"--memory", "15M"});
    renderFails(2, none, {"--compare", "gpu"});
    for (const std::vector<std::string>& option : std::vector<std::vector<std::string>>{
             {"--window-range", "2"}, {"--window-alpha", "9"}, {"--window-delta", "0.1"}, {"--window-fill"}})
        EXPECT_THAT(renderFails(2, none, option).err, HasSubstr(option[0] + " is for --method window"));
    renderFails(2, none, {"--method", "window", "--window-range", "-1"});
    renderFails(2, none, {"--method", "window", "--window-alpha", "nan"});
    for (const char* share : {"1", "-0.1", "x"})
        EXPECT_THAT(renderFails(2, none, {"--adaptive", share}).err, HasSubstr("number from 0 to 0.95"));
    renderFails(2, none, {"--error", "0"});
    renderFails(2, none, {"--debug-image", "tiles"});
    EXPECT_THAT(renderFails(2, none, {"--debug-image", "layer-map", "--method", "box"}).err,
                HasSubstr("for --method auto"));
    EXPECT_THAT(renderFails(2, none, {"--method", "ful"}).err, HasSubstr("did you mean 'full'?"));
    EXPECT_THAT(renderFails(2, SLANT_SOURCE_DIR "/scenes/row-dgauss.pbrt",
                            {"--device", "cpu", "--adaptive", "0.5", "-o", output_})
                    .err,
                HasSubstr("through a compound lens"));
    EXPECT_THAT(renderFails(2, kSpheres, {"--device", "cpu", "--crop", "480,500,0,10"}).err,
                HasSubstr("480x270"));
}

TEST_F(RenderErrors, unknownDeviceGivesStatusFour) {
    EXPECT_THAT(renderFails(4, kSpheres, {"--device", "nosuch", "-o", output_}).err, HasSubstr("nosuch"));
}

TEST_F(RenderErrors, unwritableOutputsGiveStatusFiveBeforeTracing) {
    // If anything were traced, this many samples would take minutes.
    const std::vector<std::string> job = {"reference", kSpheres, "--spp", "65536"};
    for (const std::string& output :
         {dir_.file("no/out.exr"), dir_.path().string(), kSpheres + std::string("/a.exr")})
        for (const char* option : {"-o", "--png", "--stats"}) {
            std::vector<std::string> words = job;
            words.insert(words.end(), {option, output});
            if (option != std::string("-o")) words.insert(words.end(), {"-o", output_});
            EXPECT_THAT(fails(5, words).err, HasSubstr(output));
        }
    EXPECT_EQ(dir_.entries(), 0u);
}

TEST_F(RenderErrors, fullDiscGivesStatusFive) {
    EXPECT_THAT(
        renderFails(5, emptyScene(4, 3), {"--device", "cpu", "--out-spp", "1", "-o", "/dev/full"}).err,
        HasSubstr("/dev/full"));
}

TEST_F(RenderErrors, jobsBeyondTheirMemoryGiveStatusFive) {
    EXPECT_THAT(renderFails(5, kSpheres, {"--device", "cpu", "--spp", "60000", "-o", output_}).err,
                HasSubstr("60000 samples"));
    // Tracing, if it were reached, would refuse this many samples too.
    for (const char* method : {"box", "full"})
        EXPECT_THAT(renderFails(5, emptyScene(8000, 3),
                                {"--device", "cpu", "--spp", "60000", "--memory", "16M", "--method", method,
                                 "-o", output_})
                        .err,
                    HasSubstr("memory budget is too small for a picture 8000 pixels wide"));
    EXPECT_EQ(dir_.entries(), 0u);
}

TEST_F(RenderErrors, interruptionLeavesWhatWasThere) {
    test::writeText(output_, "an older picture");
    const ProgramResult result =
        test::runAndInterrupt({SLANT_PROGRAM, "reference", kSpheres, "--spp", "65536", "--quiet", "-o",
                               output_, "--png", dir_.file("out.png"), "--stats", dir_.file("out.json")});
    EXPECT_EQ(result.status, 130) << result.err;
    EXPECT_EQ(result.errorLines(), 1) << result.err;
    EXPECT_EQ(test::readText(output_), "an older picture");
    EXPECT_EQ(dir_.entries(), 1u);
}

} // namespace
} // namespace slant

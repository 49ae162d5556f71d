// Every kind of wrong lens file ends in one line with the place and what would be right.
#include "scene/lens_file.h"
#include "support/run_program.h"
#include "support/scene_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace slant {
namespace {

std::string lensError(const std::string& text) {
    try {
        parseLens(text, "lens.dat");
    } catch (const Error& error) {
        return error.code() == ErrorCode::badInput ? error.what() : "not badInput";
    }
    return "";
}

const std::string kGood = "100 6 1.5 40\n-80 2 1 40\n0 0 1 10\n";

TEST(LensErrors, goodFilesInAnyLayout) {
    const std::string layouts[] = {kGood, kGood.substr(0, kGood.size() - 1), "# lens\r\n" + kGood,
                                   "100 6 1.5 40 -80 2\n1 40 # rear\n\n0 0 0 10"};
    for (const std::string& text : layouts) {
        EXPECT_EQ(lensError(text), "");
        const LensPrescription lens = parseLens(text, "lens.dat");
        ASSERT_EQ(lens.surfaces.size(), 3u);
        EXPECT_EQ(lens.stop, 2u);
        EXPECT_EQ(lens.surfaces[1].radius, -80);
        EXPECT_EQ(lens.surfaces[2].index, 1);
    }
}

TEST(LensErrors, wrongFiles) {
    const std::pair<std::string, std::string> cases[] = {
        {"", "lens.dat: the file has no lens surface"},
        {"# nothing\n", "lens.dat: the file has no lens surface"},
        {"100 6 1.5 40\n-80 two 1 40\n", "lens.dat:2:5: expected a number, found 'two'"},
        {"100 6 1.5 40\n\"-80\" 2 1 40\n", "lens.dat:2:1: expected a number, found \"-80\""},
        {"100 6 nan 40\n", "lens.dat:1:7: 'nan' is not a finite number in the range of a float"},
        {"1e9 6 1.5 40\n", "lens.dat:1:1: 1000000000 is out of range: a lens has at most 1000000 mm"},
        {"100 6 1.5 40\n-80 2 1\n", "lens.dat:3:1: the last surface is incomplete: a surface has four "
                                    "numbers, radius, thickness, index and diameter"},
        {"100 6 1.5 40\n-80 2 1 40\n", "lens.dat: the lens has no aperture stop: a surface of radius 0"},
        {kGood + "0 1 1 5\n", "lens.dat:4: a second aperture stop: the first is in line 3"},
        {"100 6 1.5 40\n0 2 1.5 10\n-80 2 1 40\n", "lens.dat:2: the aperture stop must stand in air"},
        {"100 -6 1.5 40\n" + kGood, "lens.dat:1: the distance to the next surface is -6, but must not be "
                                    "below 0"},
        {"100 6 0.5 40\n" + kGood, "lens.dat:1: the index of refraction is 0.5, but must be from 1 to 10, or "
                                   "0 for air"},
        {"100 6 1.5 0\n" + kGood, "lens.dat:1: the clear diameter is 0, but must be above 0"},
        {"10 6 1.5 40\n" + kGood, "lens.dat:1: a surface of radius 10 cannot have a clear diameter of 40"},
        {"0 2 1 10\n100 6 1.5 40\n-80 2 1.5 40\n", "lens.dat:3: behind the last surface must be air"},
        {"100 0 1.5 4\n-80 0 1 4\n0 0 1 1\n",
         "lens.dat: all surfaces lie in one place: every thickness is 0"},
        {"100 1 1.5 40\n-80 2 1 40\n0 0 1 10\n",
         "lens.dat:2: this surface meets the one before it, 9.688 mm from the axis: the distance of 1 mm "
         "between them is too short"},
    };
    for (const auto& [text, message] : cases) EXPECT_EQ(lensError(text), message) << text;
}

TEST(LensErrors, wrongCameras) {
    const test::TempDir dir;
    test::writeText(dir.file("lens.dat"), kGood);
    const auto camera = [&](const std::string& parameters) {
        return test::errorOf("Camera \"realistic\" \"string lensfile\" \"" + dir.file("lens.dat") + "\"\n" +
                             parameters + " WorldBegin");
    };
    EXPECT_EQ(camera("\"float aperturediameter\" 5"), "");
    EXPECT_EQ(test::errorOf("Camera \"realistic\" WorldBegin"),
              "s.pbrt:1:1: Camera \"realistic\" needs \"string lensfile\"");
    EXPECT_THAT(test::errorOf("Camera \"realistic\"\n \"string lensfile\" \"/no/lens.dat\" WorldBegin"),
                testing::StartsWith("s.pbrt:2:2: /no/lens.dat: "));
    EXPECT_EQ(camera("\"float aperturediameter\" 0"),
              "s.pbrt:2:1: 'aperturediameter' is 0, but must be above 0");
    EXPECT_EQ(camera("\"float fov\" 50"),
              "s.pbrt:2:1: Camera \"realistic\" has no parameter 'fov', or none that is supported");
    EXPECT_EQ(camera("\"string aperture\" \"star\""), "");
    EXPECT_THAT(camera("\"string aperture\" \"sta\""),
                testing::StartsWith("s.pbrt:2:1: aperture \"sta\" is not one of"));
    test::RecordingMonitor monitor;
    readSceneText("Camera \"realistic\" \"string lensfile\" \"" + dir.file("lens.dat") +
                      "\" \"float aperturediameter\" 12 WorldBegin",
                  "s.pbrt", monitor);
    ASSERT_EQ(monitor.warnings.size(), 1u);
    EXPECT_THAT(monitor.warnings[0], testing::HasSubstr("opens to 10 mm only"));
}

TEST(LensErrors, endTheProgramWithTheStatusOfInput) {
    const test::TempDir dir;
    test::writeText(dir.file("lens.dat"), kGood);
    test::writeText(dir.file("s.pbrt"), "Camera \"realistic\" \"string lensfile\" \"lens.dat\"\n"
                                        "  \"float focusdistance\" 0.2\nWorldBegin\n");
    const test::ProgramResult run =
        test::runSlant({"reference", dir.file("s.pbrt"), "--spp", "1", "--quiet", "-o", dir.file("o.exr")});
    EXPECT_EQ(run.status, 3);
    EXPECT_EQ(run.errorLines(), 1);
    EXPECT_THAT(run.err, testing::HasSubstr("s.pbrt:2:3: this lens cannot focus at 200 mm from the film"));
}

} // namespace
} // namespace slant

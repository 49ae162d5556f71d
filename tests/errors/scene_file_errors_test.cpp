// What is wrong with the files that a scene names: the message has the place in the scene and in the file.
#include "support/scene_text.h"
#include "support/temp_dir.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace slant {
namespace {

using testing::EndsWith;

class SceneFileErrors : public testing::Test {
protected:
    std::string errorIn(const std::string& main) const {
        SilentMonitor monitor;
        try {
            readScene(dir.file(main), monitor);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::badInput);
            return error.what();
        }
        return "";
    }

    test::TempDir dir;
};

TEST_F(SceneFileErrors, missingFiles) {
    EXPECT_THAT(errorIn("none.pbrt"), EndsWith("none.pbrt: there is no such file"));
    EXPECT_THAT(errorIn("."), EndsWith("is not a regular file"));
    test::writeText(dir.file("a.pbrt"), "\n Include \"b.pbrt\"");
    EXPECT_THAT(errorIn("a.pbrt"), testing::MatchesRegex(".*/a.pbrt:2:10: .*/b.pbrt: there is no such file"));
}

TEST_F(SceneFileErrors, namePlacesInIncludedFiles) {
    test::writeText(dir.file("a.pbrt"), "WorldBegin Include \"b.pbrt\"");
    test::writeText(dir.file("b.pbrt"), "\n\n  Shap");
    EXPECT_THAT(errorIn("a.pbrt"), EndsWith("b.pbrt:3:3: unknown directive 'Shap', did you mean 'Shape'?"));
}

TEST_F(SceneFileErrors, includeLoops) {
    test::writeText(dir.file("a.pbrt"), "WorldBegin\nInclude \"./a.pbrt\"");
    EXPECT_THAT(errorIn("a.pbrt"), testing::MatchesRegex(".*/a.pbrt:2:1: .*/./a.pbrt includes itself"));
    test::writeText(dir.file("b.pbrt"), "Include \"c.pbrt\"");
    test::writeText(dir.file("c.pbrt"), "Include \"b.pbrt\"");
    EXPECT_THAT(errorIn("b.pbrt"), testing::MatchesRegex(".*/c.pbrt:1:1: .*/b.pbrt includes itself"));
    for (int i = 0; i < 40; ++i)
        test::writeText(dir.file(fmt::format("d{}.pbrt", i)), fmt::format("Include \"d{}.pbrt\"", i + 1));
    EXPECT_THAT(errorIn("d0.pbrt"),
                testing::MatchesRegex(".*/d32.pbrt:1:1: files are included more than 32 deep"));
}

TEST_F(SceneFileErrors, importsThatDoNotClose) {
    test::writeText(dir.file("a.pbrt"), "WorldBegin\nImport \"b.pbrt\"");
    test::writeText(dir.file("b.pbrt"), "AttributeBegin");
    EXPECT_THAT(errorIn("a.pbrt"),
                EndsWith("a.pbrt:2:1: the imported file must close all that it opens, and nothing else"));
    test::writeText(dir.file("c.pbrt"), "Import \"b.pbrt\"");
    EXPECT_THAT(errorIn("c.pbrt"), EndsWith("c.pbrt:1:1: Import must stand after WorldBegin"));
}

TEST_F(SceneFileErrors, damagedImages) {
    const std::pair<const char*, std::string> images[] = {{"t.png", "\x89PNG\r\n\x1a\n"},
                                                          {"t.exr", "\x76\x2f\x31\x01"},
                                                          {"t.jpg", "\xff\xd8\xff\xe0"},
                                                          {"t.tga", "no image"},
                                                          {"t.hdr", "#?RADIANCE\n\n-Y 9 +X 9\n"},
                                                          {"t.pfm", "PF\n4 4\n-1\n1234"},
                                                          {"t.bmp", "BM"},
                                                          {"wide.pfm", "PF\n100000 100000\n-1\n1234"}};
    for (const auto& [name, bytes] : images) {
        test::writeText(dir.file(name), bytes);
        test::writeText(
            dir.file("a.pbrt"),
            fmt::format("WorldBegin Texture \"a\" \"float\" \"imagemap\" \"string filename\" \"{}\"", name));
        EXPECT_THAT(errorIn("a.pbrt"), testing::MatchesRegex(fmt::format(".*/a.pbrt:1:43: .*/{}: .*", name)));
    }
}

TEST_F(SceneFileErrors, keepThePlaceInTheScene) {
    test::writeText(dir.file("m.ply"), "ply\nformat ascii 1.0\nelement vertex x\n");
    test::writeText(dir.file("a.pbrt"), "WorldBegin\nShape \"plymesh\" \"string filename\" \"m.ply\"");
    EXPECT_THAT(errorIn("a.pbrt"), testing::MatchesRegex(".*/a.pbrt:2:17: .*/m.ply:3.*"));
    test::writeText(dir.file("s.spd"), "400 1 500");
    test::writeText(dir.file("b.pbrt"),
                    "WorldBegin\nMaterial \"diffuse\" \"spectrum reflectance\" \"s.spd\"");
    EXPECT_THAT(errorIn("b.pbrt"), testing::MatchesRegex(".*/b.pbrt:2:20: .*/s.spd must hold pairs of a "
                                                         "wavelength and a value, but has 3 numbers"));
    test::writeText(dir.file("s.spd"), "400 one");
    EXPECT_THAT(errorIn("b.pbrt"),
                testing::MatchesRegex(".*/b.pbrt:2:20: .*/s.spd:1:5: expected a number, found 'one'"));
}

} // namespace
} // namespace slant

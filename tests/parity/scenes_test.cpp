// The scenes that come with Slant, from file to picture: the device against the CPU at every stage, and the
// same picture whatever the thread count and however often.
#include "image/exr.h"
#include "support/run_program.h"

#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace slant {
namespace {

using test::ProgramResult;

/// A crop of odd size, and how many samples it is traced with.
struct View {
    const char* crop;
    int width, height;
    const char* spp;
};
const View kMiddle{"200,327,90,183", 127, 93, "2"};
const View kCorner{"401,462,3,50", 61, 47, "5"};

class SceneParity : public testing::TestWithParam<const char*> {
protected:
    void SetUp() override {
        const char* value = std::getenv("SLANT_TESTS_WITHOUT_VULKAN");
        if (value && std::string_view(value) == "1") GTEST_SKIP() << "SLANT_TESTS_WITHOUT_VULKAN";
    }

    /// The picture of `view` after a run that compared every stage.
    Image render(const View& view, const std::string& threads, const char* validate = "0") const {
        const test::TempDir dir;
        const std::string scene = std::string(SLANT_SOURCE_DIR "/scenes/") + GetParam() + ".pbrt";
        const std::string output = dir.file("out.exr");
        const ProgramResult run =
            test::runWords({"env", std::string("SLANT_VALIDATE=") + validate, SLANT_PROGRAM, "render", scene,
                            "--crop", view.crop, "--spp", view.spp, "--out-spp", "16", "--compare", "cpu",
                            "--float", "--quiet", "--threads", threads, "-o", output});
        EXPECT_EQ(run.status, 0) << run.err;
        EXPECT_THAT(run.out, testing::HasSubstr("agree to the bit"));
        if (run.status != 0) return {};
        Image image = readExr(output).image;
        EXPECT_EQ(image.width(), view.width);
        EXPECT_EQ(image.height(), view.height);
        return image;
    }
};

TEST_P(SceneParity, deviceEqualsCpuWithAnyThreadCount) {
    const Image once = render(kMiddle, "1", "1");
    EXPECT_TRUE(once.pixels == render(kMiddle, "2").pixels);
}

TEST_P(SceneParity, runsRepeat) {
    const Image once = render(kCorner, "2");
    EXPECT_TRUE(once.pixels == render(kCorner, "2").pixels);
    EXPECT_TRUE(once.pixels == render(kCorner, "1").pixels);
}

INSTANTIATE_TEST_SUITE_P(Scenes, SceneParity,
                         testing::Values("spheres", "row", "lights", "foliage", "indirect", "mirror",
                                         "still-life", "row-dgauss", "row-fisheye", "spin", "crossing",
                                         "dolly", "butterflies", "shadows"),
                         [](const auto& scene) {
                             std::string name = scene.param;
                             std::ranges::replace(name, '-', '_');
                             return name;
                         });

} // namespace
} // namespace slant

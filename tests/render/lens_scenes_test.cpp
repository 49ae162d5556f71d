// The row through each lens: rendered small, by brute force and by reconstruction.
#include "image/exr.h"
#include "support/run_program.h"

#include <gtest/gtest.h>

namespace slant {
namespace {

class LensScene : public testing::TestWithParam<const char*> {};

TEST_P(LensScene, rendersAsBrightAsItsReferenceFromTheCentreToTheCorner) {
    const test::TempDir dir;
    const std::string scene = std::string(SLANT_SOURCE_DIR) + "/scenes/row-" + GetParam() + ".pbrt";
    for (const std::string crop : {"224,240,150,160", "464,480,260,270"}) {
        const auto mean = [&](std::vector<std::string> words) {
            const std::string output = dir.file("out.exr");
            words.insert(words.begin() + 1, {scene, "--crop", crop, "--float", "--quiet", "-o", output});
            const test::ProgramResult run = test::runSlant(words);
            EXPECT_EQ(run.status, 0) << run.err;
            EXPECT_EQ(run.err, "");
            double sum = 0;
            const Image image = readExr(output).image;
            for (const float value : image.pixels) sum += double(value);
            return sum / double(image.pixels.size());
        };
        const double truth = mean({"reference", "--spp", "256"});
        EXPECT_GT(truth, 0.01) << crop;
        EXPECT_LT(truth, 2) << crop;
        EXPECT_NEAR(mean({"render", "--spp", "64", "--method", "box", "--device", "cpu"}) / truth, 1, 0.03)
            << crop;
        EXPECT_NEAR(mean({"render", "--spp", "64", "--out-spp", "32", "--device", "cpu"}) / truth, 1, 0.03)
            << crop;
    }
}

INSTANTIATE_TEST_SUITE_P(Row, LensScene, testing::Values("dgauss", "wide", "telephoto", "fisheye"));

} // namespace
} // namespace slant

// What is seen in a mirror moves over the lens as its image does.
#include "image/exr.h"
#include "support/run_program.h"

#include <gtest/gtest.h>

namespace slant {
namespace {

TEST(Mirror, imagesAreSharperByTheirOwnSlopes) {
    const test::TempDir dir;
    const auto picture = [&](std::vector<std::string> words) {
        const std::string output = dir.file("out.exr");
        // A part of the mirror, which is in focus, and shows a floor and a ball that are not.
        words.insert(words.begin() + 1, {std::string(SLANT_SOURCE_DIR) + "/scenes/mirror.pbrt", "--crop",
                                         "100,200,125,150", "--float", "--quiet", "-o", output});
        const test::ProgramResult run = test::runSlant(words);
        EXPECT_EQ(run.status, 0) << run.err;
        EXPECT_EQ(run.err, "");
        return readExr(output).image;
    };
    const Image truth = picture({"reference", "--spp", "256"});
    const auto errorOf = [&](const std::string& slopes) {
        const Image image = picture({"render", "--spp", "4", "--device", "cpu", "--slopes", slopes});
        double sum = 0;
        for (std::size_t i = 0; i < image.pixels.size(); ++i) {
            const double d = double(image.pixels[i] - truth.pixels[i]);
            sum += d * d;
        }
        return sum / double(image.pixels.size());
    };
    EXPECT_LT(errorOf("optics"), 0.6 * errorOf("surface")); // measured 0.42
}

} // namespace
} // namespace slant

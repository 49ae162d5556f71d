// slant reference is slant render --method box in bounded memory.
#include "image/exr.h"
#include "support/run_program.h"

#include <gtest/gtest.h>

namespace slant {
namespace {

TEST(Reference, equalsTheBoxMethodInEveryBit) {
    const test::TempDir dir;
    const std::string box = dir.file("box.exr"), reference = dir.file("reference.exr");
    for (const char* scene : {"spheres", "lights"}) { // their filters differ
        const auto picture = [&](std::vector<std::string> words, const std::string& output) {
            words.insert(words.end(), {std::string(SLANT_SOURCE_DIR "/scenes/") + scene + ".pbrt", "--crop",
                                       "471,480,0,7", "--spp", "43", "--float", "--quiet", "-o", output});
            const test::ProgramResult run = test::runSlant(words);
            EXPECT_EQ(run.status, 0) << run.err;
            return readExr(output).image;
        };
        const Image a = picture({"render", "--method", "box", "--device", "cpu"}, box);
        const Image b = picture({"reference"}, reference);
        EXPECT_EQ(a.width(), 9);
        EXPECT_TRUE(a.pixels == b.pixels) << scene;
    }
}

} // namespace
} // namespace slant

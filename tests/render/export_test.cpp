// The field that scenes/export writes with OpenEXR alone is understood as it is meant.
#include "image/exr.h"
#include "image/metrics.h"
#include "support/run_program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace slant {
namespace {

class Export : public testing::Test {
protected:
    void run(const std::vector<std::string>& words) {
        const test::ProgramResult result = test::runWords(words);
        EXPECT_EQ(result.status, 0) << testing::PrintToString(words) << result.err;
        EXPECT_EQ(result.err, "");
    }
    Image picture(const std::string& spp, const std::string& method) {
        const std::string field = dir_.file("field.exr"), output = dir_.file("out.exr");
        run({SLANT_EXPORT_EXAMPLE, field, spp});
        run({SLANT_PROGRAM, "reconstruct", field, "-o", output, "--method", method, "--device", "cpu",
             "--float", "--quiet"});
        return readExr(output).image;
    }

    test::TempDir dir_;
};

TEST_F(Export, reconstructionFitsTheFieldsOwnTruth) {
    const Image truth = picture("100", "box");
    EXPECT_EQ(truth.dataWindow, (Rect{0, 0, 96, 64}));
    const double filtered = compare(picture("8", "box"), truth).relMse;
    EXPECT_LT(compare(picture("8", "full"), truth).relMse, filtered / 4);
}

TEST_F(Export, infoKnowsItsCamera) {
    run({SLANT_EXPORT_EXAMPLE, dir_.file("field.exr")});
    const std::string info = test::runSlant({"info", dir_.file("field.exr")}).out;
    for (const char* part :
         {"frame            96x64 at (0, 0)", "focus distance   6\n", "100 pixels per unit tangent",
          "112x80 at (-8, -8) pixels, 8 each", "invalid          0 of"})
        EXPECT_THAT(info, testing::HasSubstr(part));
}

} // namespace
} // namespace slant

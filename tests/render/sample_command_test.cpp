// slant sample: what it records on request.
#include "lightfield/field_file.h"
#include "support/field_samples.h"
#include "support/run_program.h"

#include <gmock/gmock.h>

namespace slant {
namespace {

using testing::HasSubstr;

class SampleCommand : public testing::Test {
protected:
    /// The path of a field of a few pixels where a blocker throws a shadow.
    std::string sample(const std::string& name, const std::vector<std::string>& more) {
        std::vector<std::string> words = {"sample", SLANT_SOURCE_DIR "/scenes/shadows.pbrt",
                                          "--crop", "200,208,120,126",
                                          "--spp",  "2",
                                          "-o",     dir_.file(name)};
        words.insert(words.end(), more.begin(), more.end());
        const test::ProgramResult result = test::runSlant(words);
        EXPECT_EQ(result.status, 0) << result.err;
        return dir_.file(name);
    }
    static std::string infoOf(const std::string& path, const std::vector<std::string>& more = {}) {
        std::vector<std::string> words = {"info", path};
        words.insert(words.end(), more.begin(), more.end());
        return test::runSlant(words).out;
    }
    LightField read(const std::string& path) {
        SilentMonitor monitor;
        return readField(path, monitor).field;
    }

    test::TempDir dir_;
};

TEST_F(SampleCommand, recordsThePlanesThatItIsAskedFor) {
    EXPECT_THAT(infoOf(sample("a.exr", {})), HasSubstr("planes           radiance\n"));
    EXPECT_THAT(infoOf(sample("b.exr", {"--auxiliary"})),
                HasSubstr("planes           radiance, albedo, normal\n"));
    const std::string shading = sample("c.exr", {"--shading"});
    EXPECT_THAT(infoOf(shading),
                HasSubstr("planes           radiance, normal, illumination, reflectance, reflection, "
                          "position, light, blocker, direct\n"));
    EXPECT_THAT(infoOf(sample("d.exr", {"--shading", "--auxiliary"})),
                HasSubstr("radiance, albedo, normal, illumination, reflectance, reflection, "
                          "position, light, blocker, direct\n"));
    const std::string json = infoOf(shading, {"--json"});
    for (const char* part : {"\"illumination\",", "\"direct\"\n", "\"auxiliary\": false"})
        EXPECT_THAT(json, HasSubstr(part));
}

TEST_F(SampleCommand, partsOfTheRadianceLeaveItAsItIs) {
    LightField plain = read(sample("plain.exr", {})), parts = read(sample("parts.exr", {"--shading"}));
    bool lit = false;
    for (std::size_t i = 0; i < parts.samples.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            const float diffuse = parts.reflectance[i][c] * parts.illumination[i][c];
            EXPECT_NEAR(parts.radiance[i][c], diffuse + parts.reflection[i][c], 1e-4) << "nothing emits here";
            lit = lit || diffuse > 0;
        }
    EXPECT_TRUE(lit);
    parts.resize(parts.samples.size(), {});
    EXPECT_TRUE(test::sameBits(parts, plain));
}

} // namespace
} // namespace slant

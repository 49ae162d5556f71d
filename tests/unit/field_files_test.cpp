// Light field files: what is written is read again to the bit, and what others write is understood.
#include "lightfield/motion.h"
#include "lightfield/summary.h"
#include "support/deep_file.h"
#include "support/expect_error.h"
#include "support/field_samples.h"
#include "support/scene_text.h"
#include "support/temp_dir.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace slant {
namespace {

using test::DeepFile;
using test::RecordingMonitor;
using test::richField;
using test::TempDir;

class FieldFiles : public testing::Test {
protected:
    FieldFile read(const std::string& name) {
        monitor_.warnings.clear();
        return readField(dir_.file(name), monitor_);
    }
    void write(const std::string& name, const FieldFile& file) {
        writeField(dir_.file(name), file.field, file.details, monitor_);
    }

    TempDir dir_;
    RecordingMonitor monitor_;
};

void expectSame(const FieldFile& got, const FieldFile& expected) {
    EXPECT_EQ(got.field.bounds, expected.field.bounds);
    EXPECT_EQ(got.field.frame, expected.field.frame);
    EXPECT_EQ(got.field.samplesPerPixel, expected.field.samplesPerPixel);
    EXPECT_EQ(got.field.slopeModel.c1, expected.field.slopeModel.c1);
    EXPECT_EQ(got.field.slopeModel.c2, expected.field.slopeModel.c2);
    EXPECT_TRUE(got.field.lensMap.texels() == expected.field.lensMap.texels());
    EXPECT_TRUE(test::sameBits(got.field, expected.field));
    EXPECT_EQ(got.details.film, expected.details.film);
    EXPECT_EQ(metadataOf(got.field, got.details), metadataOf(expected.field, expected.details));
}

TEST_F(FieldFiles, everyFormatReadsWhatItWrote) {
    for (const int spp : {1, 3})
        for (const auto& [name, format] : {std::pair("a.exr", FieldFormat::deepExr),
                                           {"a.bin", FieldFormat::tlfrBinary},
                                           {"a.txt", FieldFormat::tlfrText}}) {
            SCOPED_TRACE(name);
            const FieldFile file = richField(spp);
            write(name, file);
            const FieldFile got = read(name);
            EXPECT_EQ(got.format, format);
            expectSame(got, file);
            EXPECT_THAT(monitor_.warnings, testing::IsEmpty());
        }
}

TEST_F(FieldFiles, everyFormatKeepsMotionToTheBit) {
    const FieldFile file = test::richMovingField();
    for (const char* name : {"a.exr", "a.bin", "a.txt"}) {
        SCOPED_TRACE(name);
        write(name, file);
        const FieldFile got = read(name);
        EXPECT_TRUE(got.field.moves());
        expectSame(got, file);
        EXPECT_THAT(monitor_.warnings, testing::IsEmpty());
    }
}

TEST_F(FieldFiles, motionOfZeroIsNone) {
    const FieldFile still = richField();
    FieldFile zero = still;
    zero.field.motion.assign(zero.field.samples.size(), glm::vec3(0, -0.f, 0));
    for (const char* name : {"a.exr", "a.bin", "a.txt"}) {
        SCOPED_TRACE(name);
        write(name, zero);
        expectSame(read(name), still);
    }
}

TEST_F(FieldFiles, everyShapeOfAperture) {
    FieldFile file = richField(1);
    Image bright({0, 0, 2, 2}, {"Y"});
    bright.pixels = {1, 0.5f, 0.25f, 0};
    for (const ApertureShape& shape :
         {*parseAperture("star", {}), *parseAperture("polygon 7 12.1", {}), apertureOfImage(bright, {})}) {
        file.field.aperture = Aperture(shape);
        for (const char* name : {"a.exr", "a.bin", "a.txt"}) {
            write(name, file);
            const FieldFile got = read(name);
            expectSame(got, file);
            EXPECT_EQ(textOf(got.field.aperture.shape()), textOf(shape));
            EXPECT_TRUE(std::ranges::equal(got.field.aperture.table(), file.field.aperture.table()));
        }
    }
}

TEST_F(FieldFiles, exrHoldsAnyNumberOfSamplesInEachPixel) {
    for (const synthetic::Counts& counts : synthetic::varyingCounts({-2, 1, 9, 8})) {
        SCOPED_TRACE(counts.name);
        FieldFile file = richField();
        file.field = synthetic::sample(synthetic::discsOverChecks(), {-2, 1, 9, 8}, 4, counts.at, 3);
        file.field.slopeModel = {-35.25f, 11.125f};
        for (LightFieldSample& s : file.field.samples) {
            s.slope = file.field.slopeModel(s.w);
            file.field.albedo.emplace_back(s.x);
            file.field.normal.emplace_back(s.y, 0, 1);
        }
        ASSERT_FALSE(file.field.pixelStart.empty());
        write("a.exr", file);
        const FieldFile got = read("a.exr");
        expectSame(got, file);
        EXPECT_TRUE(got.field.pixelStart == file.field.pixelStart);
        EXPECT_EQ(summarize(got.field).outsidePixel, 0u);
        EXPECT_THROW(write("a.bin", file), Error) << "TLFR knows one number for all";
    }
}

/// Of two radii and the fewest nodes; and of lights, if the disc is that of the stop.
std::vector<vec4> smallMap(bool ofStop) {
    std::vector<vec4> texels{
        {3, 2, 0.25f, 2}, {0.125f, 2, 1, 1}, {ofStop, 0, 0, 0}, {0, 1, 1.5f, 0.7f}, {4, 1, 1.5f, 0.1f}};
    for (int i = 0; i < 8; ++i) texels.emplace_back(0.1f * float(i), -1 / 3.f, 1e-20f, 0.5f);
    for (int i = 0; ofStop && i < 8; ++i) texels.emplace_back(0.2f, 0.5f - 0.1f * float(i), 0.75f, 0);
    return texels;
}

TEST_F(FieldFiles, everyFormatKeepsALensMap) {
    FieldFile file = richField();
    for (const bool ofStop : {false, true}) {
        file.field.lensMap = LensMap(smallMap(ofStop));
        for (const char* name : {"a.exr", "a.bin", "a.txt"}) {
            write(name, file);
            expectSame(read(name), file);
        }
    }
}

TEST_F(FieldFiles, lensMapsThatAreNoneAreRefused) {
    const auto refused = [&](const char* message, const auto& damage, bool ofStop = false) {
        std::vector<vec4> texels = smallMap(ofStop);
        damage(texels);
        FieldFile file = richField();
        file.field.lensMap = LensMap(texels);
        for (const char* name : {"a.exr", "a.txt"}) {
            write(name, file);
            test::expectError(ErrorCode::badInput, message, [&] { read(name); });
        }
    };
    refused("does not have the length", [](auto& texels) { texels.pop_back(); });
    refused("does not have the length", [](auto& texels) { texels[1].y = 3; });
    refused("too short", [](auto& texels) { texels.resize(1); });
    refused("counts or steps", [](auto& texels) { texels[0].w = 1.5f; });
    refused("counts or steps", [](auto& texels) { texels[0].z = -1; });
    refused("counts or steps", [](auto& texels) { texels[1].w = 1e30f; });
    refused("below 0", [](auto& texels) { texels[3].y = 0; });
    refused("below 0", [](auto& texels) { texels[4].w = -1; });
    refused("does not have the length", [](auto& texels) { texels[2].x = 1; });
    refused(
        "does not have the length", [](auto& texels) { texels.resize(texels.size() - 8); }, true);
    refused(
        "irradiance below 0", [](auto& texels) { texels.back().x = -1; }, true);
    refused(
        "invalid share", [](auto& texels) { texels.back().z = 1.5f; }, true);
    refused("not finite", [](auto& texels) { texels[5].x = std::numeric_limits<float>::infinity(); });
    test::expectError(ErrorCode::badInput, "not a multiple of 4", [&] {
        lensMapOf({"a"}, std::array{1.f, 2.f});
    });
}

TEST_F(FieldFiles, everyFilterAndAnEmptyDescription) {
    FieldFile file = richField();
    for (const PixelFilter& filter : {PixelFilter{FilterKind::box, {0.5f, 0.25f}},
                                      {FilterKind::triangle, {2, 1.3f}},
                                      {FilterKind::gaussian, {1.5f, 1.5f}, 0.7f},
                                      {FilterKind::sinc, {4, 4}, 0.5f, 0, 0, 2.5f}}) {
        file.details = {file.field.frame, filter, 0, 0, "", "", 0};
        for (const char* name : {"a.exr", "a.txt"}) {
            write(name, file);
            expectSame(read(name), file);
        }
    }
}

TEST_F(FieldFiles, exrKeepsEveryChoiceOfPlanes) {
    for (int choice = 0; choice < 12; ++choice) {
        SCOPED_TRACE(choice);
        const int shading = choice / 4; // nothing of it, illumination, shadow rays too
        const SamplePlanes planes{(choice & 1) != 0, shading > 0, shading > 1, (choice & 2) != 0};
        const FieldFile file = test::fieldWithPlanes(planes);
        write("a.exr", file);
        const FieldFile got = read("a.exr");
        EXPECT_EQ(got.field.hasGuides(), planes.albedo);
        EXPECT_EQ(got.field.hasShading(), planes.shading);
        EXPECT_EQ(got.field.hasShadows(), planes.shadows);
        EXPECT_EQ(got.field.moves(), planes.motion);
        EXPECT_EQ(got.field.normal.empty(), !planes.albedo && !planes.shading);
        expectSame(got, file);
    }
}

TEST_F(FieldFiles, tlfrLeavesOutAllPlanesButMotion) {
    FieldFile file =
        test::fieldWithPlanes({.albedo = true, .shading = true, .shadows = true, .motion = true});
    for (const char* name : {"a.bin", "a.txt"}) {
        write(name, file);
        FieldFile expected = file;
        expected.field.resize(file.field.samples.size(), {.motion = true});
        expectSame(read(name), expected);
    }
}

TEST_F(FieldFiles, exrKeepsSlopesOfTheirOwn) {
    FieldFile file = richField();
    for (std::size_t i = 0; i < file.field.samples.size(); i += 7) file.field.samples[i].slope = 5 + float(i);
    EXPECT_TRUE(hasOwnSlopes(file.field));
    write("a.exr", file);
    expectSame(read("a.exr"), file);
    EXPECT_THROW(write("a.txt", file), Error);
}

TEST_F(FieldFiles, tlfrReadsItsHeaderByEitherNameAndInEverySpelling) {
    for (const char* model : {"perspective", "affine"})
        for (const std::string end : {"\n", " \r\n", "\n\n"}) {
            std::string header;
            for (const std::string& line :
                 {std::string("Version 1.3"), std::string("Width 2"), std::string("Height 1"),
                  std::string("Samples per pixel 2"), "Motion model: " + std::string(model),
                  std::string("CoC coefficients (coc radius = C0/w+C1): -15.242497,19.053122"),
                  std::string("Encoding = text"),
                  std::string("x,y,z/w,w,u,v,t,r,g,b,a,mv_x,mv_y,mv_w,dwdx,dwdy")})
                header += line + end;
            test::writeText(dir_.file("a.header"), header);
            test::writeText(dir_.file("a"), "0.25,0.5,9,2,0.1,-0.2,0.3,1,2,3,7,0,0,0,5,6\r\n"
                                            "0.5, 0.75, 9, 4, 0, 0, 0, 0.5, 0.5, 0.5, 0, 0, 0, 0, 0, 0\n\n"
                                            "1.5,0.25,0,inf,0,0,1e-60,0,0,1e60,0,0,0,0,0,0\n"
                                            "1.75,0.125,0,-1,0,0,0,nan,0,0,0,1,0,-2,0,0");
            for (const char* name : {"a", "a.header"}) {
                const FieldFile file = read(name);
                EXPECT_EQ(file.format, FieldFormat::tlfrText);
                EXPECT_EQ(file.field.bounds, (Rect{0, 0, 2, 1}));
                EXPECT_EQ(file.field.frame, file.field.bounds);
                EXPECT_EQ(file.details.film, file.field.bounds);
                EXPECT_FALSE(file.details.filter);
                ASSERT_TRUE(file.field.moves());
                EXPECT_EQ(file.field.motion[0], glm::vec3(0));
                // Affine: at w = -1, from (1.75, 0.125).
                EXPECT_EQ(file.field.motion[3], model == std::string("affine") ? glm::vec3(-4.5f, -0.25f, -2)
                                                                               : glm::vec3(1, 0, -2));
                const LightFieldSample &s = file.field.samples[0], &far = file.field.samples[2];
                EXPECT_EQ(s.x, 0.25f);
                EXPECT_EQ(s.v, -0.2f);
                EXPECT_EQ(file.field.radiance[0].b, 3);
                EXPECT_EQ(s.alpha, 1);
                EXPECT_EQ(s.slope, -15.242497f / 2 + 19.053122f);
                EXPECT_EQ(far.alpha, 0);
                EXPECT_EQ(far.slope, 19.053122f);
                EXPECT_EQ(far.t, 0);
                EXPECT_TRUE(std::isinf(file.field.radiance[2].b));
                EXPECT_TRUE(std::isnan(file.field.radiance[3].r));
            }
        }
}

/// The newest programs of the method's authors leave the line out.
TEST_F(FieldFiles, withoutAMotionModelTlfrMeansPerspective) {
    const FieldFile file = test::richMovingField();
    write("a.bin", file);
    std::string header = test::readText(dir_.file("a.bin.header"));
    const std::string line = "Motion model: perspective\n";
    header.erase(header.find(line), line.size());
    test::writeText(dir_.file("a.bin.header"), header);
    expectSame(read("a.bin"), file);
}

/// What the samples of an affine file do at their own times: place, velocity and change of depth.
TEST_F(FieldFiles, affineMotionIsThatOfTheSamplesOwnTime) {
    FieldFile file = richField(1);
    synthetic::Random random(5);
    for (LightFieldSample& s : file.field.samples) {
        s.w = random.uniform() < 0.1f ? INFINITY : 1 + 5 * random.uniform();
        s.slope = file.field.slopeModel(s.w);
        file.field.motion.emplace_back(30 * random.uniform(), -8 * random.uniform(), random.uniform());
    }
    write("a.bin", file);
    std::string header = test::readText(dir_.file("a.bin.header"));
    header.replace(header.find("perspective"), 11, "affine");
    test::writeText(dir_.file("a.bin.header"), header);
    const LightField got = read("a.bin").field;
    for (std::size_t i = 0; i < got.samples.size(); ++i) {
        const LightFieldSample& s = got.samples[i];
        const glm::vec3 affine = file.field.motion[i], q = relativeMotion(s, got.motion[i]);
        const glm::vec2 p = pinholePosition(got, s);
        constexpr float kStep = 1.f / 1024;
        const glm::vec2 velocity = (moved(p, q, kStep).position - moved(p, q, -kStep).position) / (2 * kStep);
        EXPECT_NEAR(velocity.x, affine.x, 0.05) << i;
        EXPECT_NEAR(velocity.y, affine.y, 0.05) << i;
        EXPECT_EQ(got.motion[i].z, affine.z);
    }
}

TEST_F(FieldFiles, linesThatTlfrDoesNotKnowAreToldOf) {
    FieldFile file = richField();
    write("a.bin", file);
    test::writeText(dir_.file("a.bin.header"), test::readText(dir_.file("a.bin.header")) + "made by hand\n");
    expectSame(read("a.bin"), file);
    ASSERT_EQ(monitor_.warnings.size(), 1u);
    EXPECT_THAT(monitor_.warnings[0], testing::HasSubstr("made by hand"));
}

TEST_F(FieldFiles, deepFilesOfOthersNeedLittle) {
    DeepFile file;
    file.halfChannel = "R";
    file.write(dir_.file("a.exr"));
    const FieldFile got = read("a.exr");
    EXPECT_EQ(got.field.bounds, (Rect{0, 0, 5, 4}));
    EXPECT_EQ(got.field.frame, got.field.bounds);
    EXPECT_EQ(got.field.samplesPerPixel, 2);
    const LightFieldSample& s = got.field.samples[2 * (5 + 3)];
    EXPECT_EQ(s.x, 3.5f);
    EXPECT_EQ(s.y, 1.5f);
    EXPECT_EQ(got.field.radiance[2 * (5 + 3)].r, 0.5f);
    EXPECT_EQ(s.t, 0);
    EXPECT_EQ(s.alpha, 1);
    EXPECT_EQ(s.slope, 1);
}

TEST_F(FieldFiles, deepFilesOfOthersMayShareTheirShading) {
    for (const char* half : {"illumination.R", "reflectance.R", "reflection.R", "N.X"}) {
        DeepFile file;
        file.addShading();
        file.halfChannel = half;
        file.write(dir_.file("a.exr"));
        const LightField got = read("a.exr").field;
        EXPECT_FALSE(got.hasGuides());
        ASSERT_TRUE(got.hasShading());
        EXPECT_EQ(got.illumination[7], glm::vec3(0.75f, 0.5f, 2));
        EXPECT_EQ(got.reflectance[7], glm::vec3(0.5f, 0.25f, 0.125f));
        EXPECT_EQ(got.reflection[7], glm::vec3(0.0625f, 0, 1));
        EXPECT_EQ(got.normal[7], glm::vec3(0, -1, 0.5f));
    }
}

TEST_F(FieldFiles, windowsOfDeepFilesAreFrameAndOverscan) {
    DeepFile file;
    file.header.dataWindow() = {{-3, 2}, {11, 9}};
    file.header.displayWindow() = {{0, 0}, {9, 7}};
    file.channels["motion.w"] = 1;
    file.channels["motion.x"] = file.channels["motion.y"] = 0;
    file.write(dir_.file("a.exr"));
    const FieldFile got = read("a.exr");
    EXPECT_EQ(got.field.bounds, (Rect{-3, 2, 12, 10}));
    EXPECT_EQ(got.details.film, (Rect{0, 0, 10, 8}));
    EXPECT_EQ(got.field.frame, (Rect{0, 2, 10, 8}));
    EXPECT_EQ(got.field.motion, std::vector<glm::vec3>(std::size_t(15 * 8 * 2), glm::vec3(0, 0, 1)));
    EXPECT_EQ(got.field.samples[0].x, -2.5f);
    EXPECT_EQ(got.field.samples[0].y, 2.5f);
}

TEST_F(FieldFiles, summaryCountsWhatSanitizeMeets) {
    LightField field = richField().field;
    field.samples[5].x = 1000;
    const FieldSummary summary = summarize(field);
    EXPECT_EQ(summary.outsidePixel, 1u);
    EXPECT_EQ(summary.ranges[0].high, 1000);
    EXPECT_EQ(summary.ranges[5].high, 3e38f);
    EXPECT_EQ(summary.background,
              std::uint64_t(std::count_if(field.samples.begin(), field.samples.end(),
                                          [](const auto& s) { return s.w == INFINITY; })));
    const FieldDefects met = sanitize(field);
    EXPECT_GT(met.badDepth, 0u);
    EXPECT_EQ(summary.defects.badDepth, met.badDepth);
    EXPECT_EQ(summary.defects.total(), met.total());
    EXPECT_EQ(summary.moving, 0u);
}

TEST_F(FieldFiles, sanitizeClearsPartsOfTheRadianceWithoutCounting) {
    LightField field = test::fieldWithPlanes({.shading = true, .shadows = true}).field;
    const LightField before = field, plain = richField().field;
    EXPECT_EQ(sanitize(field).total(), summarize(plain).defects.total());
    for (const auto plane :
         {&SampleSet::illumination, &SampleSet::reflectance, &SampleSet::reflection, &SampleSet::direct})
        for (std::size_t i = 0; i < field.samples.size(); ++i) {
            const glm::vec3 was = (before.*plane)[i];
            EXPECT_EQ((field.*plane)[i], glm::vec3(was.r, std::isfinite(was.g) ? was.g : 0.f, 0));
        }
}

} // namespace
} // namespace slant

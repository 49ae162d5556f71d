// Light field files that are wrong: one line that says what and where, and exit status 3.
#include "lightfield/deep_exr.h"
#include "support/deep_file.h"
#include "support/expect_error.h"
#include "support/field_samples.h"
#include "support/run_program.h"

#include <ImathBox.h>

namespace slant {
namespace {

using test::DeepFile;
using test::expectError;
using test::runSlant;
using test::TempDir;
using testing::HasSubstr;

const std::string kHeader = "Version 1.3\nWidth 2\nHeight 1\nSamples per pixel 1\nMotion model: affine\n"
                            "CoC coefficients (coc radius = C0/w+C1): -15,19\nEncoding = text\n"
                            "x,y,z/w,w,u,v,t,r,g,b,a,mv_x,mv_y,mv_w,dwdx,dwdy\n";
const std::string kLine = "0.25000000000000000000000000,0.5,9,2,0.1,-0.2,0.3,1,2,3,7,0,0,0,5,6\n";

class FieldErrors : public testing::Test {
protected:
    void fails(const std::string& part, const std::string& name = "a") {
        SilentMonitor monitor;
        expectError(ErrorCode::badInput, part, [&] { readField(dir_.file(name), monitor); });
    }
    /// A TLFR file with part of its header replaced.
    void headerFails(const std::string& what, const std::string& by, const std::string& part) {
        SCOPED_TRACE(by);
        std::string header = kHeader;
        ASSERT_NE(header.find(what), std::string::npos);
        header.replace(header.find(what), what.size(), by);
        test::writeText(dir_.file("a.header"), header);
        test::writeText(dir_.file("a"), kLine + kLine);
        fails(part);
    }
    void bodyFails(const std::string& body, const std::string& part) {
        SCOPED_TRACE(body);
        test::writeText(dir_.file("a.header"), kHeader);
        test::writeText(dir_.file("a"), body);
        fails(part);
    }
    void deepFails(DeepFile file, const std::string& part) {
        file.write(dir_.file("a.exr"));
        fails(part, "a.exr");
    }

    TempDir dir_;
};

TEST_F(FieldErrors, filesThatAreNoLightField) {
    fails("there is no such file");
    test::writeText(dir_.file("a"), "something else");
    fails("is not a light field");
    test::writeText(dir_.file("b.header"), kHeader);
    fails("there is no such file", "b");
    const std::string picture = dir_.file("picture.exr");
    writeExr(picture, Image::rgb(3, 2));
    fails("without deep scanlines", "picture.exr");
}

TEST_F(FieldErrors, tlfrHeaders) {
    headerFails("1.3", "1.2", "a.header:1: version '1.2' is not 1.3");
    headerFails("Width 2", "Width two", "a.header:2: 'two' is not a whole number");
    headerFails("Width 2", "Width 0", "whole number from 1 on");
    headerFails("Width 2\n", "", "the line 'Width ...' is missing");
    headerFails("Width 2", "Width 2\nWidth 2", "a second 'Width'");
    headerFails("Width 2", "Width 99999999999", "whole number");
    headerFails("Width 2", "Width 2000000000", "the samples span");
    headerFails("Width 2\nHeight 1", "Width 1000000\nHeight 1000000", "fewer than 2^32");
    headerFails("pixel 1", "pixel 70000", "70000 samples per pixel");
    headerFails("Width 2", "Width 3", "holds 2 samples; its header has 3");
    headerFails("Width 2", "Width 200000", "holds 136 bytes; the 200000 samples of its header take at least");
    headerFails("affine", "quadratic", "quadratic");
    headerFails("-15,19", "-15", "two numbers");
    headerFails("-15,19", "nan,19", "two numbers");
    headerFails("-15,19", "1e60,19", "slope constant is not finite");
    headerFails("-15,19", "15,-19", "C1 = 15 is positive");
    headerFails("text", "ebcdic", "ebcdic");
    headerFails("text", "binary", "the 2 samples of its header take 128");
    headerFails("x,y,z/w", "x,y", "is not a line of a TLFR 1.3 header");
    headerFails("dwdy\n", "dwdy\nslant:frame 0 3 0 1\n", "is not part of the pixels");
    headerFails("dwdy\n", "dwdy\nslant:frame 0 1.5 0 1\n", "4 whole numbers");
    headerFails("dwdy\n", "dwdy\nslant:origin 4000000000 0\n", "2 whole numbers");
    headerFails("dwdy\n", "dwdy\nslant:origin 900000000 0\n", "the samples span");
    headerFails("dwdy\n", "dwdy\nslant:film 0 0 0 1\n", "the film span");
    headerFails("dwdy\n", "dwdy\nslant:colour red\n", "'slant:colour' is unknown");
    headerFails("dwdy\n", "dwdy\nslant:filter gausian 1 1 1\n", "a.header:9: filter 'gausian'");
    headerFails("dwdy\n", "dwdy\nslant:filter gausian 1 1 1\n", "did you mean 'gaussian'?");
    headerFails("dwdy\n", "dwdy\nslant:filter box 1 99\n", "two radii");
    headerFails("dwdy\n", "dwdy\nslant:lensRadius -1\n", "not a length");
    headerFails("dwdy\n", "dwdy\nslant:aperture hexagon\n",
                "a.header:9: aperture 'hexagon' is not a known shape");
    headerFails("dwdy\n", "dwdy\nslant:aperture polygon 2\n", "3 to 100 blades");
    headerFails("dwdy\n", "dwdy\nslant:aperture image 00ff\n", "131072 hexadecimal digits");
    headerFails("dwdy\n", "dwdy\nslant:seed 1.5\n", "whole number of 64 bits");
    headerFails("Version", std::string(1 << 25, '\n') + "Version", "is longer than any TLFR header");
}

TEST_F(FieldErrors, tlfrBodies) {
    bodyFails("", "holds 0 bytes");
    bodyFails(kLine, "holds 1 samples; its header has 2");
    bodyFails(kLine + kLine + kLine, "more than the 2 samples");
    bodyFails(kLine + "\n" + kLine.substr(0, 20) + "\n", ":3:");
    bodyFails(kLine + "0.25,0.5,9,2,0.1,x,0.3,1,2,3,7,0,0,0,5,6\n", ":2:18: a sample is 16 numbers");
    bodyFails(kLine + "0.25,0.5,9,2,0.1,-0.2,0.3,1,2,3,7,0,0,0,5,6,7\n", "number 16 is wrong");
    bodyFails(kLine + "0.25 0.5 9 2 0.1 -0.2 0.3 1 2 3 7 0 0 0 5 6\n", ":2:1:");
}

TEST_F(FieldErrors, deepHeaders) {
    for (const char* channel : {"R", "Z", "raster.x", "lens.v"}) {
        DeepFile file;
        file.channels.erase(channel);
        deepFails(file, fmt::format("has no channel '{}'", channel));
    }
    for (const char* channel : {"albedo.R", "N.Z", "motion.x"}) {
        DeepFile file;
        file.channels[channel] = 1;
        deepFails(file, "has no channel");
    }
    DeepFile normals;
    normals.channels.insert({{"N.X", 1}, {"N.Y", 1}, {"N.Z", 1}});
    deepFails(normals, "has no channel 'albedo.R'");
    DeepFile halves;
    halves.halfChannel = "raster.y";
    deepFails(halves, "'raster.y' must be of type float");
    DeepFile halfMotion;
    halfMotion.channels.insert({{"motion.x", 1}, {"motion.y", 1}, {"motion.w", 1}});
    halfMotion.halfChannel = "motion.w";
    deepFails(halfMotion, "'motion.w' must be of type float");
    DeepFile incomplete;
    incomplete.channels.insert({{"motion.x", 1}, {"motion.y", 1}});
    deepFails(incomplete, "has no channel 'motion.w'");
    DeepFile constants;
    constants.header.erase("slant:c2");
    deepFails(constants, "neither the float attribute 'slant:c2' nor a channel 'slope'");
    DeepFile positive;
    positive.header.insert("slant:c1", Imf::FloatAttribute(2));
    deepFails(positive, "C1 = 2 is positive");
    DeepFile filter;
    filter.header.insert("slant:filter", Imf::StringAttribute("bx 1 1"));
    deepFails(filter, "did you mean 'box'?");
    DeepFile frame;
    frame.header.insert("slant:frame", Imf::Box2iAttribute({{0, 0}, {5, 1}}));
    deepFails(frame, "the frame [0, 6) x [0, 2) is not part");
    DeepFile apart;
    apart.header.displayWindow() = {{100, 100}, {104, 103}};
    deepFails(apart, "is not part of the pixels");
}

TEST_F(FieldErrors, partsOfTheRadianceNeedEachOtherAndNormals) {
    for (const char* channel : {"illumination.R", "illumination.B", "reflectance.G", "reflection.B", "N.X"}) {
        DeepFile file;
        file.addShading();
        file.channels.erase(channel);
        deepFails(file, fmt::format("has no channel '{}'", channel));
    }
    DeepFile noNormals;
    noNormals.addShading();
    for (const char* channel : {"N.X", "N.Y", "N.Z"}) noNormals.channels.erase(channel);
    deepFails(noNormals, "has no channel 'N.X'");
    DeepFile alone;
    alone.channels["reflection.G"] = 1;
    deepFails(alone, "has no channel 'N.X'");
    DeepFile albedo;
    albedo.addShading();
    albedo.channels["albedo.G"] = 1;
    deepFails(albedo, "has no channel 'albedo.R'");
    for (const char* channel : {"illumination.G", "reflectance.R", "reflection.B", "N.Y"}) {
        DeepFile file;
        file.addShading();
        file.wholeChannel = channel;
        deepFails(file, fmt::format("'{}' must be of type float or half", channel));
    }
}

TEST_F(FieldErrors, deepCounts) {
    DeepFile crowded;
    crowded.count = [](int x, int y) { return x == 3 && y == 2 ? 70000u : 2u; };
    deepFails(crowded, "70000 samples in a pixel are more than 65536");
    DeepFile none;
    none.count = [](int, int) { return 0u; };
    deepFails(none, "holds no samples");
}

TEST_F(FieldErrors, pixelsMayDifferInTheirNumberOfSamples) {
    DeepFile file;
    file.count = [](int x, int y) { return unsigned(x == 3 && y == 2 ? 0 : 1 + x); };
    file.write(dir_.file("a.exr"));
    EXPECT_THAT(runSlant({"info", dir_.file("a.exr")}).out,
                HasSubstr("56 in 5x4 at (0, 0) pixels, 0 to 5 (2.8 on average)"));
    EXPECT_THAT(runSlant({"info", dir_.file("a.exr"), "--json"}).out, HasSubstr("\"most\": 5"));
    for (const char* method : {"box", "window", "full", "auto"}) {
        const auto result = runSlant({"reconstruct", dir_.file("a.exr"), "-o", dir_.file("out.exr"),
                                      "--device", "cpu", "--out-spp", "8", "--method", method, "--quiet"});
        EXPECT_EQ(result.status, 0) << method << ": " << result.err;
    }
}

TEST_F(FieldErrors, truncatedFilesOfEveryFormat) {
    const FieldFile file = test::richField(2);
    SilentMonitor monitor;
    for (const char* name : {"a.exr", "a.bin", "a.txt"}) {
        writeField(dir_.file(name), file.field, file.details, monitor);
        const std::string bytes = test::readText(dir_.file(name));
        // The last bytes of a text are its last number's.
        for (std::size_t size = 0; size + 40 < bytes.size(); size += size < 1000 ? 9 : bytes.size() / 50) {
            test::writeText(dir_.file(name), bytes.substr(0, size));
            EXPECT_THROW(readField(dir_.file(name), monitor), Error) << name << ' ' << size;
        }
    }
}

TEST_F(FieldErrors, theProgramSaysSoWithStatusThree) {
    test::writeText(dir_.file("a.bin"), "too short");
    test::writeText(dir_.file("a.bin.header"), kHeader);
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"info", dir_.file("a.bin")},
          {"reconstruct", dir_.file("a.bin"), "-o", dir_.file("out.exr"), "--device", "cpu", "--quiet"}}) {
        const test::ProgramResult result = runSlant(words);
        EXPECT_EQ(result.status, 3) << result.err;
        EXPECT_EQ(result.errorLines(), 1) << result.err;
        EXPECT_THAT(result.err, HasSubstr("a.bin: holds 9 bytes"));
    }
    EXPECT_EQ(dir_.entries(), 2u);
}

TEST_F(FieldErrors, motionThatCannotBeIsCounted) {
    const auto lineOf = [](const std::string& motion) {
        std::string line = kLine;
        return line.replace(line.find("7,0,0,0"), 7, "7," + motion);
    };
    test::writeText(dir_.file("a.header"), kHeader);
    test::writeText(dir_.file("a"), lineOf("nan,0,0") + lineOf("4,0,-9")); // from w = 2 at t = 0.3
    const std::string text = runSlant({"info", dir_.file("a")}).out;
    EXPECT_THAT(text, HasSubstr("moving           1 samples, by up to "));
    EXPECT_THAT(text, HasSubstr("1 of bad motion, 1 that come too near"));
    const std::string json = runSlant({"info", dir_.file("a"), "--json"}).out;
    for (const char* part :
         {"\"moving\": 1,", "\"largestMotionPx\": ", "\"badMotion\": 1", "\"limitedMotion\": 1"})
        EXPECT_THAT(json, HasSubstr(part));
    const auto result = runSlant({"reconstruct", dir_.file("a"), "-o", dir_.file("out.exr"), "--device",
                                  "cpu", "--out-spp", "1", "--quiet"});
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_THAT(result.err, HasSubstr("1 of bad motion left out; 1 would come too near"));
}

TEST_F(FieldErrors, timesThatCannotBe) {
    const FieldFile file = test::richField();
    SilentMonitor monitor;
    writeField(dir_.file("a.exr"), file.field, file.details, monitor);
    const auto reconstruct = [&](std::vector<std::string> more) {
        std::vector<std::string> words = {
            "reconstruct", dir_.file("a.exr"), "-o", dir_.file("out.exr"), "--device", "cpu", "--out-spp",
            "1",           "--quiet"};
        words.insert(words.end(), more.begin(), more.end());
        return runSlant(words);
    };
    for (const auto& [words, part] : std::vector<std::pair<std::vector<std::string>, std::string>>{
             {{"--shutter", "0.5,0.5"}, "'0.5,0.5' is not A,B with 0 <= A < B <= 1"},
             {{"--shutter", "0.6,0.5"}, "--shutter"},
             {{"--shutter", "-0.1,0.5"}, "--shutter"},
             {{"--shutter", "0,1.5"}, "--shutter"},
             {{"--shutter", "nan,1"}, "--shutter"},
             {{"--shutter", "0.5"}, "--shutter"},
             {{"--shutter", "0,0.5,1"}, "--shutter"},
             {{"--freeze", "1.5"}, "--freeze: '1.5' is not a number from 0 to 1"},
             {{"--freeze", "-1"}, "--freeze"},
             {{"--shutter", "0,0.5", "--freeze", "0"}, "--freeze"},
             {{"--freeze", "0", "--freeze-from", "0", "--freeze-to", "1", "--frames", "2"}, "--freeze"},
             {{"--freeze-from", "0", "--frames", "2"}, "--freeze-to"},
             {{"--freeze-from", "0", "--freeze-to", "1"}, "--freeze-from needs --frames"},
             {{"--focus-from", "1", "--focus-to", "2"}, "--focus-from needs --frames"},
             {{"--frames", "3"}, "--frames needs --focus-from or --freeze-from"},
             {{"--freeze", "0", "--method", "box"}, "method box takes the traced shutter only"},
             {{"--shutter", "0,0.5", "--method", "window"}, "method window looks for samples"},
             {{"--freeze-from", "0", "--freeze-to", "1", "--frames", "2", "--method", "box"},
              "method box"}}) {
        const test::ProgramResult result = reconstruct(words);
        EXPECT_EQ(result.status, 2) << result.err;
        EXPECT_EQ(result.errorLines(), 1) << result.err;
        EXPECT_THAT(result.err, HasSubstr(part));
    }
    for (const char* method : {"box", "window"})
        EXPECT_EQ(reconstruct({"--shutter", "0,1", "--method", method}).status, 0) << "as traced";
    EXPECT_THAT(reconstruct({"--freeze", "0.5"}).err, HasSubstr("nothing moves in this field"));
}

TEST_F(FieldErrors, sequencesOfInstantsAreNumbered) {
    const FieldFile file = test::richMovingField(1);
    SilentMonitor monitor;
    writeField(dir_.file("a.exr"), file.field, file.details, monitor);
    const auto result = runSlant({"reconstruct", dir_.file("a.exr"), "-o", dir_.file("slow.exr"), "--device",
                                  "cpu", "--out-spp", "1", "--quiet", "--freeze-from", "0.25", "--freeze-to",
                                  "0.75", "--focus-from", "2", "--focus-to", "4", "--frames", "3"});
    EXPECT_EQ(result.status, 0) << result.err;
    for (const auto& [name, time] :
         {std::pair("slow-0001.exr", 0.25f), {"slow-0002.exr", 0.5f}, {"slow-0003.exr", 0.75f}}) {
        const Metadata metadata = readExr(dir_.file(name)).metadata;
        EXPECT_EQ(std::get<float>(metadata.at("slant:shutterOpen")), time);
        EXPECT_EQ(std::get<float>(metadata.at("slant:shutterClose")), time);
    }
    EXPECT_FALSE(std::filesystem::exists(dir_.file("slow.exr")));
}

TEST_F(FieldErrors, wrongNamesAreUsageErrorsBeforeTracing) {
    const std::string scene = SLANT_SOURCE_DIR "/scenes/spheres.pbrt";
    for (const std::vector<std::string>& words :
         std::vector<std::vector<std::string>>{{"sample", scene, "-o", dir_.file("a.png")},
                                               {"sample", scene, "-o", dir_.file("a.bin"), "--auxiliary"},
                                               {"sample", scene, "-o", dir_.file("a.txt"), "--shading"}}) {
        const test::ProgramResult result = runSlant(words);
        EXPECT_EQ(result.status, 2) << result.err;
        EXPECT_EQ(result.errorLines(), 1) << result.err;
    }
    EXPECT_EQ(runSlant({"sample", scene, "-o", dir_.file("no/a.exr"), "--spp", "60000"}).status, 5);
}

TEST_F(FieldErrors, aFullDiskIsNotOverlooked) {
    const FieldFile file = test::richField();
    SilentMonitor monitor;
    expectError(ErrorCode::resources, "/dev/full",
                [&] { writeDeepExr("/dev/full", file.field, file.details, monitor); });
}

TEST_F(FieldErrors, lensesThatCannotBe) {
    FieldFile file = test::richField();
    SilentMonitor monitor;
    file.details.focalLength = 0;
    writeField(dir_.file("a.exr"), file.field, file.details, monitor);
    const auto reconstruct = [&](std::vector<std::string> more) {
        std::vector<std::string> words = {
            "reconstruct", dir_.file("a.exr"), "-o", dir_.file("out.exr"), "--device", "cpu", "--out-spp",
            "1",           "--quiet"};
        words.insert(words.end(), more.begin(), more.end());
        return runSlant(words);
    };
    for (const auto& [words, part] : std::vector<std::pair<std::vector<std::string>, std::string>>{
             {{"--f-stop", "4"}, "--f-stop needs a field that gives its focal length"},
             {{"--pinhole", "--f-stop", "4"}, "--f-stop"},
             {{"--focus-from", "1"}, "--focus-from"},
             {{"--focus-from", "1", "--focus-to", "2", "--frames", "1"}, "--frames"},
             {{"--focus-distance", "0"}, "--focus-distance"},
             {{"--focus-distance", "3", "--method", "box"}, "method box"},
             {{"--focus-distance", "3", "--method", "window"}, "method window"},
             {{"--pinhole", "--method", "box"}, "method box"},
             {{"--aperture", "star", "--method", "box"}, "method box"}}) {
        const test::ProgramResult result = reconstruct(words);
        EXPECT_EQ(result.status, 2) << result.err;
        EXPECT_EQ(result.errorLines(), 1) << result.err;
        EXPECT_THAT(result.err, HasSubstr(part));
    }
    EXPECT_THAT(reconstruct({"--aperture-scale", "1.5"}).err,
                HasSubstr("55 % of this lens lies outside the traced one"));
    const test::ProgramResult unknown = reconstruct({"--aperture", "stra"});
    EXPECT_EQ(unknown.status, 3) << unknown.err;
    EXPECT_THAT(unknown.err, HasSubstr("aperture \"stra\" is not one of"));
    EXPECT_THAT(unknown.err, HasSubstr("did you mean 'star'?"));
    file.field.aperture = Aperture(*parseAperture("polygon 6", {}));
    writeField(dir_.file("a.exr"), file.field, file.details, monitor);
    EXPECT_THAT(reconstruct({"--aperture", "disc"}).err, HasSubstr("17 % of this lens lies outside"));
    EXPECT_THAT(reconstruct({"--aperture", "polygon 6", "--aperture-scale", "0.9"}).err,
                testing::Not(HasSubstr("outside the traced")));
    file.details.focalLength = 0.9f; // f/1.5
    writeField(dir_.file("a.exr"), file.field, file.details, monitor);
    EXPECT_THAT(reconstruct({"--f-stop", "0.5"}).err, HasSubstr("89 % of this lens lies outside"));
    EXPECT_THAT(runSlant({"info", dir_.file("a.exr")}).out, HasSubstr("f-number         1.5\n"));
}

TEST_F(FieldErrors, invalidSamplesAreCountedAndLeftOut) {
    SilentMonitor monitor;
    const FieldFile file = test::richField();
    for (const char* name : {"a.exr", "a.txt"}) {
        writeField(dir_.file(name), file.field, file.details, monitor);
        const auto result = runSlant({"reconstruct", dir_.file(name), "-o", dir_.file("out.exr"), "--device",
                                      "cpu", "--out-spp", "8", "--quiet"});
        EXPECT_EQ(result.status, 0) << result.err;
        EXPECT_THAT(result.err, HasSubstr("invalid samples: "));
        EXPECT_THAT(runSlant({"info", dir_.file(name), "--json"}).out, HasSubstr("\"badDepth\": "));
    }
}

} // namespace
} // namespace slant

// Auxiliary channels: they have the weights of the colours, and are the same on every path to a picture.
#include "image/exr.h"
#include "lightfield/field_file.h"
#include "reconstruct/cpu_reconstructor.h"
#include "render/auxiliary.h"
#include "support/intermediates.h"
#include "support/run_program.h"
#include "support/synthetic.h"

#include <gmock/gmock.h>

namespace slant {
namespace {

using testing::HasSubstr;
using Channels = std::vector<std::string>;

const Channels kAll = {"R", "G", "B", "A", "Z", "N.X", "N.Y", "N.Z", "albedo.R", "albedo.G", "albedo.B"};

class Auxiliary : public testing::Test {
protected:
    test::ProgramResult run(std::vector<std::string> words, const std::string& output) {
        words.insert(words.end(), {"--quiet", "-o", dir_.file(output)});
        const test::ProgramResult result = test::runSlant(words);
        EXPECT_EQ(result.status, 0) << result.err;
        return result;
    }
    /// Of a few spheres and the floor behind them.
    Image picture(std::vector<std::string> words, const std::string& output) {
        words.insert(words.begin() + 1, SLANT_SOURCE_DIR "/scenes/spheres.pbrt");
        words.insert(words.end(), {"--crop", "190,230,100,130", "--float"});
        run(words, output);
        return readExr(dir_.file(output)).image;
    }

    test::TempDir dir_;
};

/// Relative to the reference's own mean square.
double relativeError(const Image& image, const Image& reference, const std::string& channel) {
    double error = 0, square = 0;
    const int a = image.channel(channel), b = reference.channel(channel);
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x) {
            error += std::pow(image.at(x, y, a) - reference.at(x, y, b), 2.0);
            square += std::pow(reference.at(x, y, b), 2.0);
        }
    return error / square;
}

TEST_F(Auxiliary, isNearTheReference) {
    const Image reference = picture({"reference", "--spp", "256", "--auxiliary"}, "reference.exr");
    EXPECT_EQ(reference.channels, kAll);
    const Image box = picture({"render", "--method", "box", "--spp", "8", "--auxiliary"}, "box.exr");
    for (const char* method : {"full", "auto"}) {
        const Image image = picture(
            {"render", "--method", method, "--spp", "8", "--out-spp", "64", "--device", "cpu", "--auxiliary"},
            "image.exr");
        EXPECT_EQ(image.channels, kAll);
        for (const std::string& channel : kAll) {
            if (channel == "A") continue; // 1 throughout
            const double error = relativeError(image, reference, channel);
            EXPECT_LT(error, 0.5 * relativeError(box, reference, channel)) << method << ' ' << channel;
            EXPECT_LT(error, 0.01) << method << ' ' << channel;
        }
        EXPECT_LT(relativeError(image, reference, "A"), 1e-10);
    }
}

TEST_F(Auxiliary, leavesTheColoursAsTheyAre) {
    const std::vector<std::string> words = {"render", "--spp", "2", "--out-spp", "16", "--device", "cpu"};
    std::vector<std::string> more = words;
    more.push_back("--auxiliary");
    const Image plain = picture(words, "plain.exr"), with = picture(more, "with.exr");
    for (int y = 0; y < plain.height(); ++y)
        for (int x = 0; x < plain.width(); ++x)
            for (int c = 0; c < 3; ++c) ASSERT_EQ(plain.at(x, y, c), with.at(x, y, c));
}

TEST_F(Auxiliary, fromAFileAndOnTheDeviceItIsTheSame) {
    const Image rendered =
        picture({"render", "--spp", "2", "--out-spp", "16", "--device", "cpu", "--auxiliary"}, "a.exr");
    run({"sample", SLANT_SOURCE_DIR "/scenes/spheres.pbrt", "--crop", "190,230,100,130", "--spp", "2",
         "--auxiliary"},
        "field.exr");
    const auto result = run({"reconstruct", dir_.file("field.exr"), "--out-spp", "16", "--float",
                             "--auxiliary", "--compare", "cpu"},
                            "b.exr");
    EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 5) << "colours and four sets";
    const Image read = readExr(dir_.file("b.exr")).image;
    EXPECT_EQ(read.channels, rendered.channels);
    EXPECT_TRUE(read.pixels == rendered.pixels);
}

TEST_F(Auxiliary, boxIsTheReferenceInEveryBit) {
    const Image box = picture({"render", "--method", "box", "--spp", "43", "--auxiliary"}, "box.exr");
    const Image reference = picture({"reference", "--spp", "43", "--auxiliary"}, "reference.exr");
    EXPECT_TRUE(box.pixels == reference.pixels);
}

/// A wall at depth 5 that moves by 0.1 to the right and 0.05 down, on a picture of 2 / 16 per pixel at
/// depth 1.
TEST_F(Auxiliary, theReferenceHasTheMotionToo) {
    test::writeText(
        dir_.file("wall.pbrt"),
        "Film \"rgb\" \"integer xresolution\" 16 \"integer yresolution\" 16\n"
        "Sampler \"independent\" \"integer pixelsamples\" 43\n"
        "Camera \"perspective\" \"float fov\" 90 \"float lensradius\" 0.1 \"float focaldistance\" 3\n"
        "WorldBegin\n"
        "ActiveTransform EndTime Translate 0.1 -0.05 0 ActiveTransform All\n"
        "Shape \"trianglemesh\" \"point3 P\" [-20 -20 5  20 -20 5  20 20 5  -20 20 5]"
        " \"integer indices\" [0 1 2  0 2 3]\n");
    Channels all = kAll;
    all.insert(all.end(), {"forward.u", "forward.v"});
    const auto picture = [&](std::vector<std::string> words, const std::string& output) {
        words.insert(words.end(), {dir_.file("wall.pbrt"), "--auxiliary", "--float"});
        run(words, output);
        return readExr(dir_.file(output)).image;
    };
    const Image reference = picture({"reference"}, "reference.exr");
    EXPECT_EQ(reference.channels, all);
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) {
            EXPECT_NEAR(reference.at(x, y, reference.channel("forward.u")), 0.1 * 8 / 5, 1e-3);
            EXPECT_NEAR(reference.at(x, y, reference.channel("forward.v")), -0.05 * 8 / 5, 1e-3);
        }
    EXPECT_TRUE(picture({"render", "--method", "box", "--spp", "43"}, "box.exr").pixels == reference.pixels);
}

TEST_F(Auxiliary, fieldsWithoutAlbedoHaveCoverageAndDepth) {
    run({"sample", SLANT_SOURCE_DIR "/scenes/spheres.pbrt", "--crop", "190,210,100,110", "--spp", "1"},
        "field.exr");
    const auto result =
        run({"reconstruct", dir_.file("field.exr"), "--out-spp", "4", "--auxiliary"}, "a.exr");
    EXPECT_THAT(result.err, HasSubstr("neither albedo nor normals"));
    EXPECT_EQ(readExr(dir_.file("a.exr")).image.channels, (Channels{"R", "G", "B", "A", "Z"}));
}

/// A disc at depth 1 before nothing: A is what part of the rays hit it, Z its depth wherever any did.
TEST_F(Auxiliary, depthIsThatOfTheRaysThatHit) {
    const Rect frame{0, 0, 40, 40};
    const std::vector<synthetic::Layer> disc = {
        {-6, [](glm::vec2 p) { return glm::length(p - 20.f) < 9; }, [](glm::vec2) { return glm::vec3(1); }},
        {4, [](glm::vec2) { return true; }, [](glm::vec2) { return glm::vec3(0); }}};
    const auto coverage = [&](int spp, Method method) {
        LightField field = synthetic::sample(disc, frame, 12, spp, 3);
        for (LightFieldSample& s : field.samples) s.w = s.w == 1 ? 5 : std::numeric_limits<float>::infinity();
        field.radiance[7].r = std::numeric_limits<float>::quiet_NaN(); // is not looked at
        ReconstructOptions options;
        options.method = method;
        options.outputsPerPixel = 64;
        CpuReconstructor cpu;
        Image image(frame, {"Y"});
        for (const AuxiliarySet& set : auxiliarySets(false, false))
            addChannels(image, set, test::run(cpu, field, options, {}, set.plane).image);
        EXPECT_EQ(image.channels, (Channels{"Y", "A", "Z"}));
        return image;
    };
    const Image truth = coverage(256, Method::box);
    for (const Method method : {Method::full, Method::automatic}) {
        const Image image = coverage(8, method);
        EXPECT_LT(relativeError(image, truth, "A"), 1e-3) << nameOf(method);
        for (std::size_t i = 0; i < frame.area(); ++i) {
            const float a = image.pixels[3 * i + 1], z = image.pixels[3 * i + 2];
            if (a > 0)
                ASSERT_NEAR(z, 5, 5e-3) << nameOf(method);
            else
                ASSERT_EQ(z, 0) << nameOf(method);
        }
    }
}

/// Half of the picture moves by (3, -2) pixels, to the right and upwards, the background by (-1, 5) pixels.
TEST_F(Auxiliary, motionIsThatOfAllRays) {
    const Rect frame{0, 0, 24, 12};
    const std::vector<synthetic::Layer> half = {
        {0, [](glm::vec2 p) { return p.x < 12; }, [](glm::vec2) { return glm::vec3(1); }}};
    FieldFile file;
    file.field = synthetic::sample(half, frame, 4, 2, 3);
    file.field.slopeModel = {0, 0};
    file.details.film = frame;
    for (LightFieldSample& s : file.field.samples) {
        s.slope = 0;
        file.field.motion.push_back(std::isinf(s.w) ? glm::vec3(-1, 5, 0) : glm::vec3(3, -2, 0));
    }
    SilentMonitor monitor;
    writeField(dir_.file("field.exr"), file.field, file.details, monitor);
    // How motion is reconstructed is not tested here: methods agree far from the edge at any rate.
    for (const char* method : {"box", "full", "auto"}) {
        run({"reconstruct", dir_.file("field.exr"), "--method", method, "--out-spp", "16", "--device", "cpu",
             "--float", "--auxiliary"},
            "a.exr");
        const Image image = readExr(dir_.file("a.exr")).image;
        const int u = image.channel("forward.u"), v = image.channel("forward.v");
        ASSERT_GE(std::min(u, v), 0);
        EXPECT_NEAR(image.at(4, 6, u), 3, 0.01) << method;
        EXPECT_NEAR(image.at(4, 6, v), 2, 0.01) << method;
        EXPECT_NEAR(image.at(20, 6, u), -1, 0.01) << method;
        EXPECT_NEAR(image.at(20, 6, v), -5, 0.01) << method;
    }
}

TEST_F(Auxiliary, valuesThatAreNotFiniteAreNothing) {
    LightField field = synthetic::sample(synthetic::discsOverChecks(), {0, 0, 2, 2}, 0, 1, 1);
    field.albedo.assign(4, glm::vec3(0.5f));
    field.normal.assign(4, glm::vec3(0, 0, -1));
    field.normal[2].y = std::numeric_limits<float>::infinity();
    EXPECT_EQ(valueOf(field, ValuePlane::normal, 1).b, 0);
    EXPECT_EQ(valueOf(field, ValuePlane::normal, 2).b, 0.5f) << "as without a normal";
    field.albedo[1].y = std::numeric_limits<float>::quiet_NaN();
    field.albedo[2].y = -3;
    for (const std::size_t i : {1, 2}) EXPECT_EQ(valueOf(field, ValuePlane::albedo, i).g, 0);
    EXPECT_EQ(valueOf(field, ValuePlane::albedo, 3).g, 0.5f);
}

} // namespace
} // namespace slant

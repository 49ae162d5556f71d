// How far away what is seen in mirrors and through glass appears, against scenes without the mirrors, and
// against the formulas of optics near an axis.
#include "support/scene_text.h"
#include "trace/tracer.h"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace slant {
namespace {

using test::sceneOf;

/// Samples of a scene seen from the origin along z, in focus at 3.
SampleSet samplesOf(const std::string& world, double fov = 40, SlopeSource slopes = SlopeSource::optics) {
    const Scene scene = sceneOf(fmt::format(
        "Film \"rgb\" \"integer xresolution\" 24 \"integer yresolution\" 24\n"
        "Integrator \"path\" \"integer maxdepth\" 6\n"
        "Camera \"perspective\" \"float fov\" {} \"float lensradius\" 0.05 \"float focaldistance\" 3\n"
        "WorldBegin LightSource \"infinite\"\n{}",
        fov, world));
    SilentMonitor monitor;
    const Tracer tracer(scene, monitor, slopes);
    SampleSet set;
    set.resize(24 * 24 * 4, {});
    tracer.trace({0, 0, 24, 24}, {0, 4}, 4, 1, spansOf(set), monitor);
    return set;
}

const char* kMirror = "Material \"conductor\" \"rgb reflectance\" [1 1 1]\n";
const char* kBallAt =
    "AttributeBegin Material \"diffuse\" Translate {} {} {} Shape \"sphere\" \"float radius\" 1.5 "
    "AttributeEnd\n";

TEST(SpecularChain, flatMirrorsShowWhatLiesBehindThem) {
    // The plane x + z = 4 shows (2, 0, 0) + ... as mirrored: (x, y, z) to (4 - z, y, 4 - x).
    const SampleSet mirrored =
        samplesOf(std::string(kMirror) +
                  "Shape \"bilinearmesh\" \"point3 P\" [ -20 -20 24  24 -20 -20  -20 20 24  24 20 -20 ]\n" +
                  fmt::format(fmt::runtime(kBallAt), -4, 0.3, 4.5));
    const SampleSet direct = samplesOf(fmt::format(fmt::runtime(kBallAt), -0.5, 0.3, 8));
    int seen = 0;
    for (std::size_t i = 0; i < direct.samples.size(); ++i) {
        const LightFieldSample &a = mirrored.samples[i], &b = direct.samples[i];
        ASSERT_EQ(a.x, b.x);
        if (!std::isfinite(b.w)) {
            EXPECT_GT(a.w, 500); // the sky
            continue;
        }
        EXPECT_NEAR(a.w, b.w, 5e-3f * b.w); // neighbours are half of a large pixel away: measured 0.003
        EXPECT_NEAR(a.slope, b.slope, 2e-2f);
        ++seen;
    }
    EXPECT_GT(seen, 500);
}

TEST(SpecularChain, panesShowWhatLiesBehindThem) {
    const std::string ball = fmt::format(fmt::runtime(kBallAt), 0.2, 0.3, 7);
    const SampleSet direct = samplesOf(ball);
    const SampleSet through =
        samplesOf("Material \"thindielectric\" \"float eta\" 1.0\n"
                  "Shape \"bilinearmesh\" \"point3 P\" [ -9 -9 3  9 -9 4  -9 9 3  9 9 4 ]\n" +
                  ball);
    for (std::size_t i = 0; i < direct.samples.size(); ++i) {
        if (!std::isfinite(direct.samples[i].w)) continue;
        EXPECT_NEAR(through.samples[i].w, direct.samples[i].w, 5e-3f * direct.samples[i].w);
    }
}

/// Mean over the samples of a small field of view, which are all on one chain.
double meanDepth(const std::string& world, SlopeSource slopes = SlopeSource::optics) {
    const SampleSet set = samplesOf(world, 0.2, slopes);
    double sum = 0;
    for (const LightFieldSample& s : set.samples) sum += 1 / double(s.w);
    return double(set.samples.size()) / sum;
}

TEST(SpecularChain, curvedMirrorsShowTheirImages) {
    // A ball of radius 2 whose front is at 4 shows the sky at half its radius behind that.
    const std::string ball = std::string(kMirror) + "Translate 0 0 6 Shape \"sphere\" \"float radius\" 2\n";
    EXPECT_NEAR(meanDepth(ball), 5, 0.01);
    EXPECT_NEAR(meanDepth(ball, SlopeSource::surface), 4, 1e-4);
    // A wall behind the camera, 6 before the ball: 1/6 + 1/b = -2/2.
    const std::string wall =
        "AttributeBegin Material \"diffuse\" Translate 0 0 -2 Shape \"disk\" \"float radius\" 99 "
        "AttributeEnd\n";
    EXPECT_NEAR(meanDepth(wall + ball), 4 + 1 / (1 + 1 / 6.0), 0.01);
}

TEST(SpecularChain, glassShowsItsImages) {
    // A plane surface of a block of glass at 2, and its floor at 2 + 3: raised to 2 + 3 / 1.5.
    EXPECT_NEAR(meanDepth("AttributeBegin Material \"dielectric\" Translate 0 0 2 "
                          "ReverseOrientation Shape \"disk\" \"float radius\" 9 AttributeEnd\n"
                          "Material \"diffuse\" Translate 0 0 5 Shape \"disk\" \"float radius\" 9\n"),
                4, 0.01); // whatever the path does: 4 % are reflected
    // A ball of radius 1 at 8 has a focal length of 1.5: the sky is seen 1.5 before its middle.
    EXPECT_NEAR(meanDepth("Material \"dielectric\" Translate 0 0 8 Shape \"sphere\"\n"), 6.5, 0.01);
}

} // namespace
} // namespace slant

// Samples where they are needed, and the estimated error that says so, on scenes with their reference.
#include "base/error.h"
#include "base/parallel.h"
#include "image/exr.h"
#include "image/metrics.h"
#include "render/brute_force.h"
#include "render/render.h"
#include "scene/read_scene.h"
#include "support/run_program.h"
#include "trace/tracer.h"

#include <gmock/gmock.h>
#include <numeric>

namespace slant {
namespace {

using testing::HasSubstr;

Scene sceneOf(const std::string& name, Rect crop) {
    SilentMonitor monitor;
    Scene scene = readScene(SLANT_SOURCE_DIR "/scenes/" + name + ".pbrt", monitor);
    scene.film.crop = crop;
    return scene;
}

/// A bar in front of others and their shadows, all in focus.
Scene shadows() {
    return sceneOf("shadows", {100, 110, 196, 174});
}

RenderOptions optionsOf(int spp, double placedShare, std::uint64_t seed = 0) {
    RenderOptions options;
    options.sampling.samplesPerPixel = spp;
    options.sampling.seed = seed;
    options.reconstruction.seed = seed;
    options.reconstruction.outputsPerPixel = 32;
    options.placedShare = placedShare;
    return options;
}

Rendering renderOnCpu(const Scene& scene, const RenderOptions& options) {
    Backend backend("cpu");
    SilentMonitor monitor;
    return render(scene, options, backend, monitor);
}

Image reference(Scene scene, int spp) {
    scene.pixelSamples = spp;
    SilentMonitor monitor;
    return bruteForce(scene, Tracer(scene, monitor), 77, monitor).image;
}

TEST(Adaptive, hasLessErrorThanAsManySamplesEverywhere) {
    const Scene scene = shadows();
    const Image truth = reference(scene, 1024);
    double adaptive = 0, uniform = 0;
    for (const std::uint64_t seed : {1, 2}) {
        const Rendering rendering = renderOnCpu(scene, optionsOf(8, 0.5, seed));
        const LightField& field = rendering.traced.field;
        EXPECT_EQ(sampleCounts(field).min, 4u);
        EXPECT_NEAR(sampleCounts(field).mean,
                    4 + 4 * double(scene.film.crop.area()) / double(field.bounds.area()), 0.01);
        adaptive += compare(rendering.image, truth).relMse;
        uniform += compare(renderOnCpu(scene, optionsOf(8, 0, seed)).image, truth).relMse;
    }
    EXPECT_LT(adaptive, 0.9 * uniform);
}

TEST(Adaptive, doesNotDependOnThreads) {
    const Scene scene = shadows();
    const Rendering all = renderOnCpu(scene, optionsOf(4, 0.5));
    const ThreadLimit one(1);
    EXPECT_EQ(renderOnCpu(scene, optionsOf(4, 0.5)).image.pixels, all.image.pixels);
}

/// Pixels with more samples are as bright in the mean as with few.
TEST(Adaptive, isUnbiased) {
    const Scene scene = sceneOf("shadows", {150, 190, 182, 214}); // a penumbra
    const Image truth = reference(scene, 4096);
    const auto meanOf = [](const Image& image) {
        return std::accumulate(image.pixels.begin(), image.pixels.end(), 0.0) / double(image.pixels.size());
    };
    double sum = 0;
    constexpr int kSeeds = 64;
    for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
        RenderOptions options = optionsOf(4, 0.5, seed);
        options.reconstruction.method = Method::box;
        sum += meanOf(renderOnCpu(scene, options).image);
    }
    EXPECT_NEAR(sum / kSeeds / meanOf(truth), 1, 0.002);
}

TEST(Adaptive, goesOnUntilTheErrorIsReached) {
    const Scene scene = shadows();
    RenderOptions options = optionsOf(2, 0);
    options.targetRelMse = 1e9;
    const Rendering first = renderOnCpu(scene, options);
    EXPECT_EQ(sampleCounts(first.traced.field).max, 2u);
    options.targetRelMse = *first.estimatedRelMse / 3;
    const Rendering rendering = renderOnCpu(scene, options);
    EXPECT_LE(*rendering.estimatedRelMse, *options.targetRelMse);
    EXPECT_LT(sampleCounts(rendering.traced.field).mean, 6);
}

TEST(Adaptive, saysWhereTheBudgetEndsBefore) {
    struct : Monitor {
        std::string warnings;
        void beginStage(std::string_view, std::uint64_t, std::string_view) override {}
        void advance(std::uint64_t) override {}
        void endStage() override {}
        void warn(std::string_view message) override { warnings += message; }
    } monitor;
    RenderOptions options = optionsOf(1, 0);
    options.targetRelMse = 1e-9;
    options.sampling.memoryBytes = 16 << 20;
    Backend backend("cpu");
    const Rendering rendering = render(shadows(), options, backend, monitor);
    EXPECT_THAT(monitor.warnings, HasSubstr("instead of 1e-09: the memory budget has no room for more than"));
    EXPECT_GT(sampleCounts(rendering.traced.field).mean, 2);
}

TEST(Adaptive, isTheSameOnTheDevice) {
    const test::TempDir dir;
    const test::ProgramResult result =
        test::runSlant({"render", SLANT_SOURCE_DIR "/scenes/shadows.pbrt", "--crop", "150,182,190,214",
                        "--spp", "4", "--out-spp", "32", "--adaptive", "0.5", "--error-channels", "--compare",
                        "cpu", "-o", dir.file("a.exr"), "--quiet"});
    EXPECT_EQ(result.status, 0) << result.err;
    // The picture, and two halves each of the first samples and of all.
    EXPECT_EQ(std::ranges::count(result.out, '\n'), 5) << result.out;
    EXPECT_THAT(result.out, HasSubstr("agree to the bit"));
}

TEST(Adaptive, refusesCompoundLenses) {
    EXPECT_THROW(renderOnCpu(sceneOf("row-dgauss", {0, 0, 16, 16}), optionsOf(2, 0.5)), Error);
}

/// On tiles of 16 pixels, the estimate is the true error within a factor of two.
TEST(ErrorChannels, areCalibrated) {
    const Scene scenes[] = {sceneOf("shadows", {80, 90, 240, 218}), sceneOf("row", {190, 70, 318, 182})};
    for (const Scene& scene : scenes) {
        const Image truth = reference(scene, 256);
        RenderOptions options = optionsOf(4, 0);
        options.errorChannels = true;
        const Rendering rendering = renderOnCpu(scene, options);
        const Image& image = rendering.image;
        const int first = image.channel("error.R");
        int tiles = 0, good = 0;
        constexpr int kTile = 16;
        for (int y0 = 0; y0 + kTile <= image.height(); y0 += kTile)
            for (int x0 = 0; x0 + kTile <= image.width(); x0 += kTile) {
                double estimated = 0, found = 0;
                for (int y = y0; y < y0 + kTile; ++y)
                    for (int x = x0; x < x0 + kTile; ++x)
                        for (int c = 0; c < 3; ++c) {
                            estimated += std::pow(image.at(x, y, first + c), 2);
                            found += std::pow(image.at(x, y, c) - truth.at(x, y, c), 2);
                        }
                ++tiles;
                good += estimated < 4 * found && found < 4 * estimated;
            }
        EXPECT_GE(good, 0.8 * tiles) << scene.path << ": " << good << " of " << tiles;
        EXPECT_GT(*rendering.estimatedRelMse,
                  0.5 * compare(image.withChannels({"R", "G", "B"}), truth).relMse);
        EXPECT_LT(*rendering.estimatedRelMse, 2 * compare(image.withChannels({"R", "G", "B"}), truth).relMse);
    }
}

TEST(ErrorChannels, areThoseOfTheFieldFile) {
    const test::TempDir dir;
    const auto run = [&](std::vector<std::string> words) {
        words.insert(words.end(), {"--quiet"});
        const test::ProgramResult result = test::runSlant(words);
        EXPECT_EQ(result.status, 0) << result.err;
    };
    const std::string scene = SLANT_SOURCE_DIR "/scenes/spheres.pbrt", crop = "190,230,100,130";
    run({"render", scene, "--crop", crop, "--spp", "4", "--error-channels", "--float", "-o",
         dir.file("a.exr")});
    run({"sample", scene, "--crop", crop, "--spp", "4", "-o", dir.file("field.exr")});
    run({"reconstruct", dir.file("field.exr"), "--error-channels", "--float", "-o", dir.file("b.exr")});
    const Image a = readExr(dir.file("a.exr")).image, b = readExr(dir.file("b.exr")).image;
    EXPECT_EQ(a.channels, (std::vector<std::string>{"R", "G", "B", "error.R", "error.G", "error.B"}));
    EXPECT_EQ(a.pixels, b.pixels);
}

} // namespace
} // namespace slant

// What must hold for a reconstruction of any field: constants stay, order does not matter, brightness stays,
// and the error falls.
#include "image/metrics.h"
#include "reconstruct/cpu_reconstructor.h"
#include "support/intermediates.h"
#include "support/shaded.h"
#include "support/synthetic.h"

#include <numeric>

namespace slant {
namespace {

const std::vector<Method> kMethods = {Method::box, Method::full, Method::automatic};
const std::vector<Method> kReconstructions = {Method::full, Method::automatic};

Image reconstruct(const LightField& field, Method method, int outputs = 32, float lensScale = 1) {
    ReconstructOptions options;
    options.method = method;
    options.outputsPerPixel = outputs;
    CpuReconstructor cpu;
    return test::run(cpu, field, options, {.apertureScale = lensScale}).image;
}

LightField discs(Rect frame, int spp, std::uint32_t seed) {
    return synthetic::sample(synthetic::discsOverChecks(), frame, 15, spp, seed);
}

const Rect kFrame{0, 0, 96, 72};

/// The truth, nearly.
Image manySamples() {
    return reconstruct(discs(kFrame, 400, 77), Method::box);
}

double meanOf(const Image& image) {
    return std::accumulate(image.pixels.begin(), image.pixels.end(), 0.0) / double(image.pixels.size());
}

TEST(ReconstructStability, constantRadianceStays) {
    const vec3 colour(0.7f, 1e-3f, 800);
    for (const int spp : {1, 4, 9}) {
        LightField field = discs({0, 0, 40, 31}, spp, 5);
        synthetic::Random random(9);
        std::ranges::fill(field.radiance, colour);
        for (LightFieldSample& s : field.samples) s.slope = 40 * random.uniform() - 20;
        for (const Method method : kMethods) {
            const Image image = reconstruct(field, method);
            for (std::size_t i = 0; i < image.pixels.size(); ++i)
                ASSERT_NEAR(image.pixels[i] / colour[int(i % 3)], 1, 1e-5) << spp << ", value " << i;
        }
    }
}

TEST(ReconstructStability, orderWithinAPixelIsNothing) {
    const LightField field = discs({0, 0, 40, 31}, 8, 5);
    LightField reversed = field;
    for (std::size_t first = 0; first < field.samples.size(); first += 8) {
        std::reverse(reversed.samples.begin() + long(first), reversed.samples.begin() + long(first) + 8);
        std::reverse(reversed.radiance.begin() + long(first), reversed.radiance.begin() + long(first) + 8);
    }
    for (const Method method : kMethods)
        EXPECT_LT(compare(reconstruct(reversed, method), reconstruct(field, method)).maxAbs, 1e-5);
}

TEST(ReconstructStability, brightnessStays) {
    const double exact = meanOf(manySamples());
    // With 1 sample per pixel the field itself is 0.5 % off, as its plain mean shows.
    for (const Method method : kReconstructions)
        for (const auto& [spp, bound] : {std::pair(1, 0.01), {4, 0.005}, {16, 0.005}, {64, 0.005}})
            EXPECT_NEAR(meanOf(reconstruct(discs(kFrame, spp, 21), method, 64)) / exact, 1, bound)
                << nameOf(method) << ", " << spp;
}

TEST(ReconstructStability, fourSamplesReconstructedBeatSixteenFiltered) {
    const Image reference = manySamples();
    const double box = compare(reconstruct(discs(kFrame, 16, 2), Method::box), reference).mse;
    for (const Method method : kReconstructions)
        EXPECT_LT(compare(reconstruct(discs(kFrame, 4, 1), method, 64), reference).mse, 0.5 * box)
            << nameOf(method);
}

/// The truth is the field of a lens smaller by that factor.
TEST(ReconstructStability, smallerAperturesComeFromTheSameSamples) {
    const LightField field = discs(kFrame, 16, 1);
    for (const float lensScale : {0.5f, 0.f}) {
        std::vector<synthetic::Layer> layers = synthetic::discsOverChecks();
        for (synthetic::Layer& layer : layers) layer.slope *= lensScale;
        const LightField smaller = synthetic::sample(layers, kFrame, 15, 400, 77);
        const Image truth = reconstruct(smaller, Method::box);
        for (const Method method : kReconstructions) {
            const double narrow = compare(reconstruct(field, method, 64, lensScale), truth).mse;
            EXPECT_LT(narrow, 0.1 * compare(reconstruct(field, method, 64), truth).mse)
                << nameOf(method) << ", " << lensScale;
        }
    }
}

/// A bright strip that is seen past the blurred edge of a dark thing in front: solid, though most of its
/// samples are hidden. Weighted by its bare density it let the black ground through, up to 6 % of its light.
TEST(ReconstructStability, stripBehindABlurredEdgeIsSolid) {
    const auto colour = [](float value) { return [value](vec2) { return vec3(value); }; };
    const std::vector<synthetic::Layer> layers = {{-8, [](vec2 p) { return p.x < 46; }, colour(0.1f)},
                                                  {0.5f, [](vec2 p) { return p.x < 52; }, colour(1)},
                                                  {9, [](vec2) { return true; }, colour(0)}};
    const Image truth = reconstruct(synthetic::sample(layers, kFrame, 15, 400, 77), Method::box);
    for (const auto& [method, spp] : {std::pair(Method::full, 2),
                                      {Method::full, 4},
                                      {Method::full, 16},
                                      {Method::automatic, 2},
                                      {Method::automatic, 4},
                                      {Method::automatic, 16}}) {
        const Image image = reconstruct(synthetic::sample(layers, kFrame, 15, spp, 21), method, 128);
        for (int x = 38; x < 51; ++x) {
            double got = 0, wanted = 0;
            for (int y = 8; y < 64; ++y) {
                got += image.pixels[3 * std::size_t(y * kFrame.width() + x)];
                wanted += truth.pixels[3 * std::size_t(y * kFrame.width() + x)];
            }
            EXPECT_NEAR(got / 56, wanted / 56, 0.012)
                << nameOf(method) << ", x " << x << ", " << spp << " samples per pixel";
        }
    }
}

/// Bright discs, some smaller than the distance between samples, neither grow nor fade.
TEST(ReconstructStability, smallDiscsKeepTheirBrightness) {
    const auto colour = [](float value) { return [value](vec2) { return vec3(value); }; };
    for (const float radius : {0.4f, 0.8f, 1.6f, 3.f})
        for (const float slope : {-4.f, 0.2f}) {
            const auto inside = [radius](vec2 p) {
                return glm::length(p - (glm::floor(p / 12.f) + 0.5f) * 12.f) < radius;
            };
            const std::vector<synthetic::Layer> layers = {{slope, inside, colour(1)},
                                                          {9, [](vec2) { return true; }, colour(0)}};
            for (const int spp : {2, 4, 16}) {
                double full = 0, automatic = 0,
                       wanted = 0; // of the same samples, so that their noise does not count
                for (const std::uint32_t seed : {31, 32}) {
                    const LightField field = synthetic::sample(layers, kFrame, 15, spp, seed);
                    full += meanOf(reconstruct(field, Method::full, 32));
                    automatic += meanOf(reconstruct(field, Method::automatic, 32));
                    wanted += meanOf(reconstruct(field, Method::box));
                }
                EXPECT_NEAR(full / wanted, 1, 0.06)
                    << "radius " << radius << ", slope " << slope << ", " << spp;
                EXPECT_NEAR(automatic / wanted, 1, 0.06)
                    << "radius " << radius << ", slope " << slope << ", " << spp;
            }
        }
}

/// Where nothing is blurred, samples are filtered as they are, if there are enough of them and their noise is
/// known.
TEST(ReconstructStability, inFocusSamplesAreThePicture) {
    const auto layersOf = [](float slope) {
        return std::vector<synthetic::Layer>{
            {slope, [](vec2 p) { return glm::length(p - 24.f) < 14; }, [](vec2 p) { return vec3(p.x / 48); }},
            {0, [](vec2) { return true; }, [](vec2 p) { return vec3(0.5f, p.y / 48, 0.2f); }}};
    };
    const auto isPlain = [&](float slope, int spp, const LensView& view, bool known = true) {
        LightField field = synthetic::sample(layersOf(slope), {0, 0, 48, 48}, 2, spp, 7);
        if (known) test::lightUp(field, {.noise = 0});
        ReconstructOptions options;
        options.outputsPerPixel = 16;
        options.anyFocus = true;
        CpuReconstructor cpu;
        SilentMonitor monitor;
        ReconstructReport report;
        const Image image = cpu.reconstruct(field, options, monitor, report, nullptr, view);
        options.method = Method::box;
        options.anyFocus = false;
        return image.pixels == cpu.reconstruct(field, options, monitor, report, nullptr).pixels;
    };
    EXPECT_TRUE(isPlain(0.05f, 4, {}));
    EXPECT_FALSE(isPlain(0.05f, 4, {}, false));
    EXPECT_FALSE(isPlain(0.05f, 2, {}));
    EXPECT_FALSE(isPlain(0.5f, 4, {}));
    EXPECT_FALSE(isPlain(0.05f, 4, {.slopeShift = 2}));
    EXPECT_FALSE(isPlain(4, 4, {.apertureScale = 0})); // traced out of focus
}

} // namespace
} // namespace slant

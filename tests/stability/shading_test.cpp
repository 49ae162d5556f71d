// What must hold for the filter of shading: noise falls, brightness stays, and what is no noise stays.
#include "image/metrics.h"
#include "reconstruct/cpu_reconstructor.h"
#include "support/intermediates.h"
#include "support/shaded.h"

namespace slant {
namespace {

const Rect kFrame{0, 0, 96, 72};

Image reconstruct(const LightField& field, Method method = Method::automatic) {
    ReconstructOptions options;
    options.method = method;
    options.outputsPerPixel = 32;
    CpuReconstructor cpu;
    return test::run(cpu, field, options).image;
}

LightField lit(int spp, const test::Lit& how, std::uint32_t seed = 5) {
    LightField field = synthetic::sample(synthetic::discsOverChecks(), kFrame, 15, spp, seed);
    test::lightUp(field, how);
    return field;
}

/// A plane in focus, lit from `how`.
LightField plane(int spp, const test::Lit& how, std::uint32_t seed = 5) {
    const std::vector<synthetic::Layer> layers = {
        {0, [](vec2) { return true; }, [](vec2) { return vec3(0.5f); }}};
    LightField field = synthetic::sample(layers, kFrame, 4, spp, seed);
    test::lightUp(field, how);
    return field;
}

TEST(ShadingStability, whatHasNoNoiseStaysToTheBit) {
    for (const int spp : {1, 4, 16}) {
        const LightField field = lit(spp, {.noise = 0, .reflection = 0.2f});
        EXPECT_TRUE(reconstruct(field).pixels == reconstruct(field, Method::unfiltered).pixels) << spp;
    }
}

TEST(ShadingStability, noiseFallsAndTexturesAndBrightnessStay) {
    for (const int spp : {2, 4, 16})
        for (const std::uint32_t seed : {5u, 6u}) {
            const test::Lit noisy{.reflection = 0.2f, .seed = seed};
            const LightField field = lit(spp, noisy, seed);
            const Image truth =
                reconstruct(lit(spp, {.noise = 0, .reflection = 0.2f}, seed), Method::unfiltered);
            const Metrics filtered = compare(reconstruct(field), truth),
                          plain = compare(reconstruct(field, Method::unfiltered), truth);
            EXPECT_LT(filtered.mse, plain.mse / 3.5) << spp << " samples, seed " << seed;
            EXPECT_NEAR(filtered.drift, plain.drift, 0.005) << spp << " samples, seed " << seed;
        }
}

/// Squared error of the picture of a plane against the shadow's closed form.
double shadowError(float height, int spp, bool known, std::uint32_t seed, double* mean = nullptr) {
    LightField field = plane(spp, {.noise = 0, .seed = seed, .shadow = height}, seed);
    if (!known) field.resize(field.samples.size(), {.shading = true});
    const Image image = reconstruct(field);
    double sum = 0, offsets = 0;
    for (int y = 0; y < image.height(); ++y)
        for (int x = 8; x < image.width() - 8; ++x) {
            const double off =
                double(image.at(x, y, 0)) - 0.5 * double(test::shadowShare(height, float(x) + 0.5f));
            sum += off * off;
            offsets += off;
        }
    const double pixels = double(image.height()) * (image.width() - 16);
    if (mean) *mean = offsets / pixels;
    return sum / pixels;
}

// Measured: 1.2 to 2.5 times less error than without shadow rays, which lie at random here.
TEST(ShadingStability, softShadowsOfAnyWidthComeOutOfShadowRays) {
    for (const float height : {0.1f, 0.5f, 0.9f})
        for (const int spp : {4, 8})
            for (const std::uint32_t seed : {5u, 6u}) {
                double mean;
                const double with = shadowError(height, spp, true, seed, &mean),
                             without = shadowError(height, spp, false, seed);
                EXPECT_LT(with, without / 1.1) << height << ", " << spp << " samples";
                EXPECT_NEAR(mean, 0, 0.0025) << height << ", " << spp << " samples";
            }
}

/// Many samples look at what is dark, and few at what is bright beside it: it is as bright as before.
TEST(ShadingStability, numbersOfSamplesDoNotWeighLight) {
    const std::vector<synthetic::Layer> layers = {
        {0, [](vec2) { return true; }, [](vec2) { return vec3(0.5f); }}};
    const auto isDark = [](int x) { return x / 3 % 2 == 0; };
    LightField field = synthetic::sample(
        layers, kFrame, 4, [&](int x, int) { return isDark(x + 300) ? 16 : 2; }, 5);
    test::lightUp(field, {.light = [&](vec2 p) { return isDark(int(std::floor(p.x)) + 300) ? 0.9f : 1.1f; }});
    EXPECT_NEAR(compare(reconstruct(field), reconstruct(field, Method::box)).drift, 0, 0.002);
}

TEST(ShadingStability, pictureDoesNotDependOnTheOneBefore) {
    const LightField field = lit(4, {});
    ReconstructOptions options;
    options.outputsPerPixel = 16;
    options.anyFocus = true;
    LensView other;
    other.slopeShift = -20;
    CpuReconstructor cpu;
    const auto pictureAfter = [&](const std::vector<std::pair<LensView, ValuePlane>>& before) {
        const auto prepared = cpu.prepare(field, options);
        SilentMonitor monitor;
        ReconstructReport report;
        for (const auto& [view, plane] : before) prepared->picture(view, plane, monitor, report, nullptr);
        return prepared->picture({}, ValuePlane::radiance, monitor, report, nullptr).pixels;
    };
    EXPECT_TRUE(pictureAfter({}) == pictureAfter({{other, ValuePlane::radiance}}));
    EXPECT_TRUE(pictureAfter({}) ==
                pictureAfter({{other, ValuePlane::radiance}, {other, ValuePlane::coverage}}));
}

/// Where light ends at a line, the filter never does harm, and its error falls as samples grow.
TEST(ShadingStability, edgesOfShadowsStaySharp) {
    const auto shadow = [](vec2 p) { return p.x + 0.3f * p.y < 60 ? 1.f : 0.1f; };
    double before = 1;
    for (const int spp : {1, 4, 16, 64, 256}) {
        const Image truth = reconstruct(plane(spp, {.light = shadow, .noise = 0}), Method::unfiltered);
        const LightField field = plane(spp, {.light = shadow, .noise = 0.9f});
        const double filtered = compare(reconstruct(field), truth).mse,
                     plain = compare(reconstruct(field, Method::unfiltered), truth).mse;
        EXPECT_LT(filtered, 0.6 * plain) << spp;
        EXPECT_LT(filtered, 0.75 * before) << spp;
        before = filtered;
    }
}

/// A sheet in the light before a dark wall, and two walls that meet: neither lights the other.
TEST(ShadingStability, surfacesKeepTheirOwnLight) {
    const std::vector<synthetic::Layer> layers = {
        {0.2f, [](vec2 p) { return p.x < 40; }, [](vec2) { return vec3(1); }},
        {3, [](vec2) { return true; }, [](vec2) { return vec3(1); }}};
    LightField field = synthetic::sample(layers, kFrame, 8, 4, 5);
    test::lightUp(field, {.noise = 0});
    const auto darken = [&](std::size_t i, float light) {
        field.illumination[i] = vec3(light);
        field.radiance[i] = field.reflectance[i] * field.illumination[i];
    };
    for (std::size_t i = 0; i < field.samples.size(); ++i) {
        const LightFieldSample& s = field.samples[i];
        const bool behind = s.slope > 1;
        if (behind && s.x - s.slope * s.u > 70) field.normal[i] = vec3(1, 0, 0);
        darken(i, !behind ? 1.f : field.normal[i].x > 0 ? 0.5f : 0.f);
    }
    EXPECT_TRUE(reconstruct(field).pixels == reconstruct(field, Method::unfiltered).pixels);
}

} // namespace
} // namespace slant

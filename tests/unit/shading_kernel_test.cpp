// The kernels of the filter of shading (shaders/lib/shading.glsl) and the bands that it works in.
#include "lib/shading.glsl"
#include "reconstruct/shading_filter.h"
#include "support/synthetic.h"

#include <gtest/gtest.h>
#include <limits>

namespace slant {
namespace {

const vec3 kUp(0, 1, 0);

TEST(ShadingKernel, surfacesDifferInNormalAndDepth) {
    const vec4 floor(kUp, 0.1f);
    EXPECT_EQ(unlikeness(floor, floor), 0);
    EXPECT_LT(unlikeness(floor, vec4(kUp, 0.103f)), 1);
    EXPECT_GT(unlikeness(floor, vec4(kUp, 0.12f)), 1);
    EXPECT_GT(unlikeness(floor, vec4(1, 0, 0, 0.1f)), 1);
    EXPECT_EQ(unlikeness(floor, vec4(kUp, 0.12f)), unlikeness(vec4(kUp, 0.12f), floor));
}

TEST(ShadingKernel, aPlaneIsLikeItselfAlongItsSlope) {
    const vec4 here(kUp, 0.1f);
    const vec2 slopes(0.01f, -0.02f), offset(3, 1);
    EXPECT_EQ(likeness(here, slopes, here, vec2(0)), 1);
    EXPECT_NEAR(likeness(here, slopes, vec4(kUp, 0.1f + 0.03f - 0.02f), offset), 1, 1e-4);
    EXPECT_EQ(likeness(here, slopes, vec4(kUp, 0.2f), offset), 0);
    EXPECT_EQ(likeness(here, slopes, vec4(0, 0, 1, 0.11f), offset), 0);
}

TEST(ShadingKernel, signalIsWhatBothHalvesHave) {
    EXPECT_EQ(keptShare(0, 0), 1) << "no detail, no noise";
    EXPECT_EQ(keptShare(1, 1), 1);
    EXPECT_EQ(keptShare(-0.5f, 1), 0);
    EXPECT_NEAR(keptShare(0.5f, 1), 2.f / 3, 1e-6) << "signal 1, noise 1 in each half, 1/2 in their mean";
}

/// Details of signal s and noise n in each half: the mean over many bands finds both.
TEST(ShadingKernel, bandsTellSignalFromNoise) {
    synthetic::Random random(1);
    const auto draw = [&] { return 2 * random.uniform() - 1; };
    double covariance = 0, variance = 0;
    for (int i = 0; i < 20000; ++i) {
        const float signal = 0.3f * draw();
        const auto half = [&] { return vec4(3.f * vec3(10 + signal + 0.6f * draw()), 3); };
        const Band band = bandOf(half(), half(), vec4(vec3(50), 5), vec4(vec3(50), 5));
        covariance += double(band.covariance);
        variance += double(band.variance);
    }
    const double s = 0.3 * 0.3 / 3, n = 0.6 * 0.6 / 3;
    EXPECT_NEAR(covariance / variance, s / (s + n), 0.01);
}

TEST(ShadingKernel, halvesThatAreMissingTellNothing) {
    const vec4 none(0), some(2, 2, 2, 1);
    const Band band = bandOf(some, none, some, some);
    EXPECT_EQ(band.variance, 0);
    EXPECT_EQ(band.detail, vec3(0));
}

TEST(ShadingKernel, whereAllIsKeptLightStaysToTheBit) {
    synthetic::Random random(2);
    for (int i = 0; i < 1000; ++i) {
        const vec3 light(random.uniform(), 1e-6f * random.uniform(), 1e6f * random.uniform());
        const vec4 change = changedBy(vec4(0), vec3(random.uniform()), 1, true);
        EXPECT_EQ(filteredLight(light, vec4(random.uniform()), change), light);
    }
    const vec4 none = changedBy(vec4(0), vec3(0.25f), 0, true);
    EXPECT_EQ(filteredLight(vec3(3), vec4(1), none), vec3(0.75f)) << "the mean less the detail";
    EXPECT_EQ(filteredLight(vec3(3), vec4(0.1f), none), vec3(0)) << "never negative";
}

TEST(ShadingKernel, texelsAreThoseOfPinholePosition) {
    const ShadingLayout layout{{-3, 5}, {10, 4}};
    EXPECT_EQ(texelOf(layout, vec2(-3, 5)), 0u);
    EXPECT_EQ(texelOf(layout, vec2(-2.5f, 6.5f)), 10u);
    EXPECT_EQ(texelOf(layout, vec2(6.99f, 8.99f)), 39u);
    constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
    for (const vec2 outside : {vec2(7, 6), vec2(-3.01f, 6), vec2(0, 4.9f), vec2(0, 9), vec2(kNaN, 6),
                               vec2(1e30f, 6), vec2(-1e30f, 6)})
        EXPECT_EQ(texelOf(layout, outside), 40u);
}

TEST(ShadingFilter, bandsCoverAllRowsWithTheirSurroundings) {
    GridLayout grid{};
    grid.origin = vec2(-10, -20);
    grid.invCell = 1;
    grid.cellsPerBrick = 16;
    grid.brickCount = {20, 40};
    grid.bucketCount = 1;
    grid.invBucket = 1;
    LightField field;
    field.frame = {0, 0, 100, 500};
    field.reflection = {vec3(0), vec3(0, 1, 0)};
    const ShadingPlan plan = planShading(field, grid, 1 << 30);
    EXPECT_TRUE(plan.reflects);
    const std::vector<ShadingBand>& whole = plan.bands;
    ASSERT_EQ(whole.size(), 1u);
    EXPECT_EQ(whole[0].firstRow, 0);
    EXPECT_EQ(whole[0].lastRow, whole[0].layout.size.y);
    const std::vector<ShadingBand> cut = planShading(field, grid, 1 << 23).bands;
    ASSERT_GT(cut.size(), 2u);
    int next = whole[0].layout.origin.y;
    for (const ShadingBand& band : cut) {
        EXPECT_EQ(band.layout.origin.y + band.firstRow, next);
        next = band.layout.origin.y + band.lastRow;
        EXPECT_GE(band.firstRow,
                  std::min(46, band.layout.origin.y + band.firstRow - whole[0].layout.origin.y));
        EXPECT_EQ(band.layout.origin.x, whole[0].layout.origin.x);
        EXPECT_EQ(band.layout.size.x, whole[0].layout.size.x);
    }
    EXPECT_EQ(next, whole[0].layout.origin.y + whole[0].layout.size.y);
}

TEST(ShadingKernel, shadowRaysEndWhereSomethingIsInTheWay) {
    LightField field;
    field.samples.resize(1);
    field.resize(1, {.shading = true, .shadows = true});
    const vec3 from(1, 2, 3), way(0, 8, 0);
    const auto rayTo = [&](vec3 blocker, vec3 light) {
        field.position[0] = from;
        field.blocker[0] = blocker;
        field.light[0] = light;
        return shadowRayOf(field, 0);
    };
    EXPECT_EQ(rayTo(from + 0.25f * way, from + way), vec4(from, 0.25f));
    EXPECT_EQ(rayTo(from + way, from + way), vec4(from, kUnblocked));
    EXPECT_EQ(rayTo(from, from).w, 0) << "no ray";
    EXPECT_GT(rayTo(from, from + way).w, 0) << "blocked at once";
    EXPECT_EQ(rayTo(from, vec3(INFINITY)).w, 0);
    EXPECT_EQ(rayTo(vec3(std::numeric_limits<float>::quiet_NaN()), from + way).w, 0);
}

} // namespace
} // namespace slant

// The filter of shading on the compute path against the CPU's, to the bit.
#include "compute/compute_reconstructor.h"
#include "reconstruct/cpu_reconstructor.h"
#include "support/intermediates.h"
#include "support/shaded.h"
#include "support/vulkan_fixture.h"

#include <cmath>
#include <limits>

namespace slant {
namespace {

class ShadingParity : public test::VulkanTest {
protected:
    /// Returns the CPU's picture.
    static Image expectSame(const LightField& field, const LensView& view = {},
                            std::uint64_t memoryBytes = 1 << 30) {
        ReconstructOptions options;
        options.outputsPerPixel = 16;
        options.anyFocus = view.slopeShift != 0;
        options.memoryBytes = memoryBytes;
        CpuReconstructor cpu;
        ComputeReconstructor compute(device());
        const test::Reconstruction expected = test::run(cpu, field, options, view);
        const test::Reconstruction got = test::run(compute, field, options, view);
        test::expectEqual(expected.intermediates, got.intermediates);
        for (const float value : got.image.pixels) EXPECT_TRUE(std::isfinite(value));
        return expected.image;
    }
    static LightField discs(Rect frame, int spp, const test::Lit& lit = {}) {
        LightField field = synthetic::sample(synthetic::discsOverChecks(), frame, 15, spp, 7);
        test::lightUp(field, lit);
        return field;
    }
};

const Rect kFrame{-7, 3, 30, 36};

TEST_F(ShadingParity, everyStageAtOddSizes) {
    for (const Rect frame : {Rect{0, 0, 61, 43}, kFrame, Rect{5, 5, 6, 6}})
        for (const int spp : {1, 3, 8})
            for (const float reflection : {0.f, 0.3f})
                expectSame(discs(frame, spp, {.reflection = reflection}));
}

TEST_F(ShadingParity, shadowRays) {
    for (const Rect frame : {Rect{0, 0, 61, 43}, kFrame, Rect{38, 5, 41, 6}})
        for (const int spp : {1, 3, 8, 20, 50})
            expectSame(discs(frame, spp, {.noise = 0.2f, .shadow = 0.4f}));
    LightField field = discs(kFrame, 6, {.reflection = 0.5f, .shadow = 0.8f});
    synthetic::Random random(6);
    const float draws[] = {std::numeric_limits<float>::quiet_NaN(), 1e30f, 0, -1, 1e-30f, INFINITY, 3};
    for (std::size_t i = 0; i < field.samples.size(); ++i)
        for (auto plane : {&SampleSet::position, &SampleSet::light, &SampleSet::blocker, &SampleSet::direct})
            if (random.bits() % 9 == 0)
                (field.*plane)[i][int(i % 3)] = draws[random.bits() % std::size(draws)];
    sanitize(field);
    expectSame(field);
}

TEST_F(ShadingParity, otherFocusesAndThingsThatMove) {
    LensView view;
    view.slopeShift = -6;
    expectSame(discs(kFrame, 4), view);
    LightField moving = synthetic::sampleMoving(synthetic::movingDiscs(), kFrame, 20, 4, 7);
    test::lightUp(moving, {.shadow = 0.3f});
    expectSame(moving);
}

TEST_F(ShadingParity, pixelsThatDifferInTheirNumberOfSamples) {
    for (const synthetic::Counts& counts : synthetic::varyingCounts(kFrame)) {
        LightField field = synthetic::sample(synthetic::discsOverChecks(), kFrame, 15, counts.at, 7);
        test::lightUp(field, {.reflection = 0.2f});
        expectSame(field);
    }
}

TEST_F(ShadingParity, anything) {
    LightField field = discs(kFrame, 6, {.reflection = 0.5f});
    synthetic::Random random(5);
    constexpr float kNaN = std::numeric_limits<float>::quiet_NaN(), kHuge = 1e30f;
    for (std::size_t i = 0; i < field.samples.size(); ++i) {
        const float draws[] = {kNaN, kHuge, 0, -1, 1e-30f, std::numeric_limits<float>::infinity(), 3};
        const auto draw = [&] { return draws[random.bits() % std::size(draws)]; };
        if (i % 5 == 0) field.illumination[i] = vec3(draw(), 1, draw());
        if (i % 7 == 0) field.normal[i] = vec3(draw(), draw(), 1);
        if (i % 11 == 0) field.reflectance[i] = vec3(draw());
        if (i % 13 == 0) field.reflection[i] = vec3(draw(), draw(), 0);
        if (i % 17 == 0) field.samples[i].w = draw();
        if (i % 19 == 0) field.samples[i].slope = 2000 * (random.uniform() - 0.5f);
    }
    sanitize(field);
    expectSame(field);
}

TEST_F(ShadingParity, resultDoesNotDependOnMemory) {
    const LightField field = discs({0, 0, 40, 120}, 4);
    const std::uint64_t bandBytes = 12'000'000; // of a map and of shading, each half
    const SceneSideSamples samples(field);
    const Bins bins = binSamples(samples, {field.bounds, false});
    EXPECT_GT(planShading(field, bins.grid, bandBytes / 2).bands.size(), 1u);
    EXPECT_TRUE(expectSame(field).pixels == expectSame(field, {}, bandBytes).pixels);
}

} // namespace
} // namespace slant

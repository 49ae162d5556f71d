// Where the compute path of `window` leaves outputs to the CPU. What holds of every method is in
// reconstruct_test.cpp.
#include "compute/compute_reconstructor.h"
#include "reconstruct/cpu_reconstructor.h"
#include "shared/window.h"
#include "support/intermediates.h"
#include "support/synthetic.h"
#include "support/vulkan_fixture.h"

namespace slant {
namespace {

class WindowParity : public test::VulkanTest {
protected:
    static ReconstructReport runBoth(const LightField& field, const WindowOptions& window) {
        ReconstructOptions options;
        options.method = Method::window;
        options.window = window;
        options.outputsPerPixel = 8;
        CpuReconstructor cpu;
        ComputeReconstructor compute(device());
        const test::Reconstruction expected = test::run(cpu, field, options);
        const test::Reconstruction got = test::run(compute, field, options);
        test::expectEqual(expected.intermediates, got.intermediates);
        EXPECT_EQ(expected.report.outputs, got.report.outputs);
        EXPECT_EQ(expected.report.search.visibility, got.report.search.visibility);
        EXPECT_EQ(expected.report.search.widened, got.report.search.widened);
        EXPECT_EQ(expected.report.search.holes, got.report.search.holes);
        EXPECT_EQ(expected.report.search.overflowed, 0u);
        return got.report;
    }

    static LightField makeField(int spp) {
        return synthetic::sample(synthetic::discsOverChecks(), {3, -2, 34, 21}, 15, spp, 7);
    }
};

TEST_F(WindowParity, everyOption) {
    for (const WindowOptions& window : {WindowOptions{.rangePx = 0},
                                        {.rangePx = 1, .fill = true},
                                        {.rangePx = 13, .alpha = 0},
                                        {.rangePx = 40, .alpha = 1e6f, .lensStep = 0.f},
                                        {.rangePx = 5, .alpha = 3, .lensStep = 2.f, .fill = true}}) {
        const ReconstructReport report = runBoth(makeField(2), window);
        EXPECT_EQ(report.search.overflowed, 0u);
        EXPECT_EQ(report.search.widened > 0, window.fill);
    }
}

TEST_F(WindowParity, denseSpotsAreDoneOnTheCpu) {
    LightField field = makeField(12);
    synthetic::Random random(3);
    for (std::size_t i = 0; i < field.samples.size(); i += 5) { // gathers what lies before x = 12
        LightFieldSample& s = field.samples[i];
        if (s.x < 12) s.x = 12 + 0.2f * random.uniform(), s.slope = random.uniform();
    }
    const ReconstructReport report = runBoth(field, {.rangePx = 20});
    EXPECT_GT(report.search.overflowed, 0u);
    EXPECT_LT(report.search.overflowed, report.outputs / 2);
}

TEST_F(WindowParity, windowsWithTooManySamplesAreDoneOnTheCpu) {
    const LightField field = synthetic::sample(synthetic::discsOverChecks(), {3, -2, 14, 7}, 15, 9, 7);
    EXPECT_EQ(runBoth(field, {.rangePx = 40}).search.overflowed, 0u);
    const ReconstructReport report = runBoth(field, {.rangePx = 41});
    EXPECT_EQ(report.search.overflowed, report.outputs);
}

TEST_F(WindowParity, sortingAsManyAsFitStaysBelowTheLoopLimit) {
    // Slopes fall from sample to sample, so that each is put before all others, and there are nearly
    // kMaxWindowCandidates around an output: the pattern holds 4 pi, and is drawn together by 2.1 twice.
    LightField field = synthetic::sample(synthetic::discsOverChecks(), {13, 5, 23, 13}, 44, 9, 7);
    float slope = 1;
    for (LightFieldSample& s : field.samples) {
        s.slope = slope *= 0.9999f;
        s.x = 18 + (s.x - 18) / 2.1f;
        s.y = 9 + (s.y - 9) / 2.1f;
    }
    const ReconstructReport report = runBoth(field, {.rangePx = 40, .alpha = 1});
    EXPECT_LT(report.search.overflowed, report.outputs / 4);
}

} // namespace
} // namespace slant

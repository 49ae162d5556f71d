// The compute path against the CPU's where things move, stage by stage, to the bit.
#include "compute/compute_reconstructor.h"
#include "reconstruct/cpu_reconstructor.h"
#include "support/intermediates.h"
#include "support/synthetic.h"
#include "support/vulkan_fixture.h"

#include <cmath>

namespace slant {
namespace {

class MotionParity : public test::VulkanTest {
protected:
    static void expectSame(const LightField& field, Method method, const LensView& view = {},
                           int outputs = 16) {
        ReconstructOptions options;
        options.method = method;
        options.outputsPerPixel = outputs;
        options.window.rangePx = 3;
        options.anyFocus = view.slopeShift != 0;
        CpuReconstructor cpu;
        ComputeReconstructor compute(device());
        const test::Reconstruction expected = test::run(cpu, field, options, view);
        const test::Reconstruction got = test::run(compute, field, options, view);
        test::expectEqual(expected.intermediates, got.intermediates);
        EXPECT_EQ(expected.report.search.holes, got.report.search.holes);
        EXPECT_EQ(expected.report.search.visibility, got.report.search.visibility);
        for (const float value : got.image.pixels) ASSERT_TRUE(std::isfinite(value));
    }
};

TEST_F(MotionParity, everyStageAtOddSizes) {
    for (const Rect frame : {Rect{0, 0, 61, 43}, Rect{-7, 3, 30, 36}, Rect{5, 5, 6, 6}})
        for (const int spp : {1, 3, 8}) {
            const LightField field = synthetic::sampleMoving(synthetic::movingDiscs(), frame, 20, spp, 7);
            for (const Method method : {Method::box, Method::window, Method::full, Method::automatic})
                expectSame(field, method);
        }
}

} // namespace
} // namespace slant

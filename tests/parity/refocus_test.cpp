// Pictures of a prepared field at several focuses, of colours and of other values: the compute path against
// the CPU path, stage by stage, to the bit.
#include "compute/compute_reconstructor.h"
#include "lightfield/refocus.h"
#include "reconstruct/cpu_reconstructor.h"
#include "support/intermediates.h"
#include "support/synthetic.h"
#include "support/vulkan_fixture.h"

namespace slant {
namespace {

class RefocusParity : public test::VulkanTest {
protected:
    static test::Reconstruction picture(PreparedField& prepared, float slopeShift,
                                        ValuePlane plane = ValuePlane::radiance) {
        test::Reconstruction run;
        SilentMonitor monitor;
        run.image = prepared.picture({slopeShift}, plane, monitor, run.report, &run.intermediates);
        return run;
    }

    /// Pictures of three focuses, then of depths.
    static void expectSamePictures(const LightField& field, const ReconstructOptions& options,
                                   bool overflows) {
        ComputeReconstructor onDevice(device());
        const auto device = onDevice.prepare(field, options),
                   cpu = CpuReconstructor().prepare(field, options);
        for (const float shift : {0.f, 4.5f, -13.25f, 4.5f}) {
            const test::Reconstruction got = picture(*device, shift);
            test::expectEqual(picture(*cpu, shift).intermediates, got.intermediates);
            EXPECT_EQ(got.report.search.overflowed > 0, overflows);
        }
        for (const float shift : {4.5f, 0.f})
            test::expectEqual(picture(*cpu, shift, ValuePlane::depth).intermediates,
                              picture(*device, shift, ValuePlane::depth).intermediates);
    }

    static ReconstructOptions optionsOf(Method method) {
        ReconstructOptions options;
        options.method = method;
        options.outputsPerPixel = 16;
        options.anyFocus = true;
        return options;
    }
};

TEST_F(RefocusParity, everyStageOfEveryFocus) {
    const LightField field = synthetic::sample(synthetic::discsOverChecks(), {-3, 2, 40, 27}, 15, 3, 7);
    for (const Method method : {Method::full, Method::automatic})
        expectSamePictures(field, optionsOf(method), false);
}

TEST_F(RefocusParity, whatIsFinishedOnTheCpuIsAtThatFocusToo) {
    LightField field = synthetic::sample(synthetic::discsOverChecks(), {0, 0, 12, 9}, 2, 50, 7);
    synthetic::Random random(3);
    for (LightFieldSample& s : field.samples) { // all in one spot of the traced focus, and of one not far off
        s.slope = 0.1f * random.uniform();
        s.x = 5.9f + 0.2f * random.uniform() + s.slope * s.u;
        s.y = 3.9f + 0.2f * random.uniform() + s.slope * s.v;
    }
    expectSamePictures(field, optionsOf(Method::full), true);
}

TEST_F(RefocusParity, planesOfMethodsWithoutBins) {
    const LightField field = synthetic::sample(synthetic::discsOverChecks(), {0, 0, 20, 16}, 8, 3, 7);
    for (const Method method : {Method::box, Method::window}) {
        ReconstructOptions options = optionsOf(method);
        options.window.rangePx = 2;
        ComputeReconstructor onDevice(device());
        const auto prepared = onDevice.prepare(field, options);
        picture(*prepared, 0);
        EXPECT_EQ(picture(*prepared, 0, ValuePlane::depth).image.pixels,
                  picture(*CpuReconstructor().prepare(field, options), 0, ValuePlane::depth).image.pixels);
    }
}

} // namespace
} // namespace slant

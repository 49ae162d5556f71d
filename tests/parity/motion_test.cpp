// The compute path against the CPU's where things move, stage by stage, to the bit.
#include "compute/compute_reconstructor.h"
#include "reconstruct/cpu_reconstructor.h"
#include "scene/read_scene.h"
#include "support/intermediates.h"
#include "support/synthetic.h"
#include "support/vulkan_fixture.h"
#include "trace/sample_pass.h"

#include <array>
#include <cmath>
#include <limits>

namespace slant {
namespace {

const std::vector<Method> kMethods = {Method::box, Method::window, Method::full, Method::automatic};

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

const Rect kFrame{-7, 3, 30, 36};

LightField moving(int spp, const synthetic::MovingView& view = {}) {
    return synthetic::sampleMoving(synthetic::movingDiscs(), kFrame, 20, spp, 7, view);
}

TEST_F(MotionParity, everyStageAtOddSizes) {
    for (const Rect frame : {Rect{0, 0, 61, 43}, kFrame, Rect{5, 5, 6, 6}})
        for (const int spp : {1, 3, 8}) {
            const LightField field = synthetic::sampleMoving(synthetic::movingDiscs(), frame, 20, spp, 7);
            for (const Method method : kMethods) expectSame(field, method);
        }
}

TEST_F(MotionParity, pinholesAndWhatChangesItsOrder) {
    for (const Method method : kMethods) {
        expectSame(moving(3, {.pinhole = true}), method);
        for (const bool pinhole : {false, true})
            expectSame(
                synthetic::sampleMoving(synthetic::overtakingDiscs(), kFrame, 20, 3, 7, {.pinhole = pinhole}),
                method);
    }
}

TEST_F(MotionParity, everyView) {
    LensView view;
    for (const auto& [open, close] : {std::pair(0.f, 0.f), {0.7f, 0.7f}, {0.25f, 0.75f}})
        for (const float slopeShift : {0.f, -6.f})
            for (const Method method : {Method::full, Method::automatic}) {
                view.shutterOpen = open;
                view.shutterClose = close;
                view.slopeShift = slopeShift;
                view.apertureScale = slopeShift == 0 ? 1 : 0.6f;
                expectSame(moving(3), method, view, 64);
            }
}

TEST_F(MotionParity, pixelsThatDifferInTheirNumberOfSamples) {
    for (const synthetic::Counts& counts : synthetic::varyingCounts(kFrame)) {
        const LightField field = synthetic::sampleLayers(
            synthetic::MovingLayers{synthetic::movingDiscs(), {}}, kFrame, 20, counts.at, 7, {});
        for (const Method method : kMethods) expectSame(field, method);
    }
}

TEST_F(MotionParity, anyMotion) {
    LightField field = moving(4);
    synthetic::Random random(5);
    const auto draw = [&](float most) { return most * (2 * random.uniform() - 1); };
    const std::array<float, 6> sizes = {1, 30, 300, 1e4f, 1e-30f, 1e30f};
    for (std::size_t i = 0; i < field.samples.size(); ++i) {
        const float size = sizes[random.bits() % sizes.size()];
        field.motion[i] = {draw(size), draw(size), draw(i % 3 == 0 ? 5 : 0.5f)};
        if (i % 11 == 0) field.motion[i] = vec3(0);
        if (i % 13 == 0) field.motion[i].x = std::numeric_limits<float>::quiet_NaN();
        if (i % 17 == 0) field.samples[i].w = std::numeric_limits<float>::infinity();
        if (i % 19 == 0) field.samples[i].slope = draw(2000);
    }
    const FieldDefects defects = sanitize(field);
    EXPECT_GT(defects.badMotion, 0u);
    EXPECT_GT(defects.limitedMotion, 0u);
    for (const Method method : kMethods) expectSame(field, method);
}

/// A ball that crosses a wall behind a double Gauss, lit by a sky.
TEST_F(MotionParity, anySlopeAndDepth) {
    for (const bool pinhole : {false, true}) {
        LightField field = moving(3, {.pinhole = pinhole});
        const std::array slopes = {3e38f, -3e38f, 1e30f, -0.f};
        const std::array depths = {1e-45f, 1e-38f, 3e38f};
        for (std::size_t i = 0; i < field.samples.size(); i += 7) {
            if (i % 2 == 0) field.motion[i] = glm::vec3(0);
            field.samples[i].slope = slopes[i % slopes.size()];
            field.samples[i].w = depths[i % depths.size()];
        }
        sanitize(field);
        for (const Method method : kMethods) expectSame(field, method);
    }
}

TEST_F(MotionParity, throughACompoundLens) {
    SilentMonitor monitor;
    const Scene scene = readSceneText(
        "Film \"rgb\" \"integer xresolution\" 48 \"integer yresolution\" 27 \"float diagonal\" 36\n"
        "Camera \"realistic\" \"string lensfile\" \"" SLANT_SOURCE_DIR
        "/scenes/lenses/dgauss-50mm.dat\" \"float aperturediameter\" 17.1 \"float focusdistance\" 0.6\n"
        "WorldBegin LightSource \"infinite\" \"rgb L\" [1 2 3]\n"
        "Shape \"bilinearmesh\" \"point3 P\" [-2 -2 2  2 -2 2  -2 2 2  2 2 2]\n"
        "ActiveTransform EndTime Translate 0.06 0.02 -0.3 ActiveTransform All\n"
        "Translate -0.1 0 1.2 Shape \"sphere\" \"float radius\" 0.08\n",
        "s.pbrt", monitor);
    const Tracer tracer(scene, monitor);
    LightField field = traceLightField(tracer, scene, {.samplesPerPixel = 3}, monitor);
    EXPECT_EQ(sanitize(field).total(), 0u);
    EXPECT_TRUE(field.moves());
    EXPECT_FALSE(field.lensMap.empty());
    for (const Method method : kMethods) expectSame(field, method);
    LensView instant;
    instant.shutterOpen = instant.shutterClose = 0.8f;
    expectSame(field, Method::automatic, instant);
}

TEST_F(MotionParity, filmDoesNotDependOnMemory) {
    const LightField field = moving(8);
    for (const Method method : {Method::full, Method::automatic}) {
        ReconstructOptions options;
        options.method = method;
        options.outputsPerPixel = 64;
        ComputeReconstructor compute(device());
        const test::Reconstruction plenty = test::run(compute, field, options);
        options.memoryBytes = method == Method::full ? 700'000 : 12'600'000;
        const test::Reconstruction tight = test::run(compute, field, options);
        EXPECT_GT(tight.intermediates.names.size(), plenty.intermediates.names.size());
        EXPECT_TRUE(plenty.intermediates.contents.back() == tight.intermediates.contents.back());
    }
}

} // namespace
} // namespace slant

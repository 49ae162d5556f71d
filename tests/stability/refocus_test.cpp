// A field traced once, seen through a lens focused elsewhere, is as if it had been traced that way.
#include "image/metrics.h"
#include "lightfield/refocus.h"
#include "reconstruct/cpu_reconstructor.h"
#include "reconstruct/field_bins.h"
#include "support/expect_error.h"
#include "support/intermediates.h"
#include "support/synthetic.h"

#include <cmath>

namespace slant {
namespace {

const Rect kFrame{0, 0, 60, 44};
constexpr float kC1 = -31.5f;

/// Discs over checks at depths 1, 2 and 3, through a lens of these constants.
LightField traced(float c2, int spp, std::uint32_t seed) {
    std::vector<synthetic::Layer> layers = synthetic::discsOverChecks();
    const SlopeModel model{kC1, c2};
    for (std::size_t i = 0; i < layers.size(); ++i) layers[i].slope = model(float(i + 1));
    LightField field = synthetic::sample(layers, kFrame, 24, spp, seed);
    field.slopeModel = model;
    return field;
}

float shiftTo(const LightField& field, double distance) {
    return focusedAt(field, distance).c2 - field.slopeModel.c2;
}

ReconstructOptions optionsOf(Method method) {
    ReconstructOptions options;
    options.method = method;
    options.outputsPerPixel = 32;
    options.anyFocus = true;
    return options;
}

Image picture(PreparedField& prepared, float slopeShift, ValuePlane plane = ValuePlane::radiance) {
    SilentMonitor monitor;
    ReconstructReport report;
    return prepared.picture({slopeShift}, plane, monitor, report, nullptr);
}

/// Alone.
Image picture(const LightField& field, Method method, float slopeShift = 0) {
    return picture(*CpuReconstructor().prepare(field, optionsOf(method)), slopeShift);
}

TEST(Refocus, isAsGoodAsTracingAgain) {
    const LightField field = traced(19.5f, 9, 1);
    for (const double distance : {1.1, 4.0}) {
        const float c2 = float(-kC1 / distance);
        const Image truth = picture(traced(c2, 196, 77), Method::box);
        const double again = compare(picture(traced(c2, 9, 1), Method::full), truth).relMse;
        const double moved = compare(picture(field, Method::full, shiftTo(field, distance)), truth).relMse;
        EXPECT_LT(moved, 2 * again) << distance;
    }
}

TEST(Refocus, movesSlopesAndNothingElseInTheBins) {
    const LightField field = traced(19.5f, 3, 1);
    EXPECT_NEAR(*focusDistance(field.slopeModel), 31.5 / 19.5, 1e-6);
    const SceneSideSamples samples(field);
    const Bins before = binSamples(samples, {kFrame, true});
    EXPECT_EQ(before.positions.size(), field.samples.size()) << "another focus may need any of them";
    const std::size_t cells = std::size_t(before.grid.cellsPerBrick * before.grid.cellsPerBrick);
    FieldBins focused(samples, {kFrame, true});
    for (const double distance : {0.25, 2.0, 1e9, double(INFINITY)}) {
        const SlopeModel model = focusedAt(field, distance);
        EXPECT_NEAR(model.c2, -kC1 / distance, 1e-5);
        focused.refocus(shiftTo(field, distance));
        const Bins& bins = focused.bins();
        EXPECT_EQ(bins.cellStart, before.cellStart);
        for (std::size_t i = 0; i < bins.positions.size(); ++i) {
            const vec4 &a = before.positions[i], &b = bins.positions[i];
            ASSERT_TRUE(a.x == b.x && a.y == b.y && a.w == b.w);
            ASSERT_NEAR(b.z, model(field.samples[bins.samples[i]].w), 1e-4);
        }
        for (std::size_t k = 0; k < bins.bricks.size(); ++k) {
            float low = INFINITY, high = -INFINITY;
            for (uint i = bins.cellStart[k * cells]; i < bins.cellStart[(k + 1) * cells]; ++i) {
                low = std::min(low, bins.positions[i].z);
                high = std::max(high, bins.positions[i].z);
            }
            ASSERT_EQ(bins.bricks[k].slopeMin, low);
            ASSERT_EQ(bins.bricks[k].slopeMax, high);
        }
    }
    focused.refocus(0);
    EXPECT_EQ(focused.bins().positions, before.positions);
}

TEST(Refocus, picturesDoNotDependOnThoseBefore) {
    const LightField field = traced(19.5f, 4, 1);
    const float near = shiftTo(field, 1.1), far = shiftTo(field, 4);
    for (const Method method : {Method::full, Method::automatic}) {
        const auto prepared = CpuReconstructor().prepare(field, optionsOf(method));
        const std::vector<Image> series = {picture(*prepared, near), picture(*prepared, far),
                                           picture(*prepared, 0), picture(*prepared, near)};
        EXPECT_EQ(series[0].pixels, picture(field, method, near).pixels);
        EXPECT_EQ(series[1].pixels, picture(field, method, far).pixels);
        EXPECT_EQ(series[2].pixels, picture(field, method).pixels);
        EXPECT_EQ(series[3].pixels, series[0].pixels);
        EXPECT_NE(series[1].pixels, series[0].pixels);

        const Image depths = picture(*prepared, near, ValuePlane::depth);
        EXPECT_EQ(
            depths.pixels,
            picture(*CpuReconstructor().prepare(field, optionsOf(method)), near, ValuePlane::depth).pixels);
        EXPECT_NE(depths.pixels, series[0].pixels);
        EXPECT_EQ(picture(*prepared, near).pixels, series[0].pixels) << "the field is as it was";
    }
}

/// If all samples are kept for any focus, the grid lies elsewhere: a few outputs at rims come out
/// differently.
TEST(Refocus, atTheTracedFocusChangesNothing) {
    const LightField field = traced(19.5f, 4, 1);
    for (const Method method : {Method::full, Method::automatic}) {
        ReconstructOptions options = optionsOf(method);
        options.anyFocus = false;
        const Image plain = picture(*CpuReconstructor().prepare(field, options), 0);
        EXPECT_LT(compare(picture(field, method), plain).relMse, 1e-4) << nameOf(method);
    }
}

TEST(Refocus, isRefusedWhereItIsNotPrepared) {
    const LightField field = traced(19.5f, 1, 1);
    for (const Method method : {Method::box, Method::window})
        test::expectError(ErrorCode::usage, "in their own pixels", [&] { picture(field, method, 1); });
    ReconstructOptions options = optionsOf(Method::full);
    options.anyFocus = false;
    test::expectError(ErrorCode::usage, "prepared for the traced focus only",
                      [&] { picture(*CpuReconstructor().prepare(field, options), 1); });
}

TEST(Refocus, saysHowMuchOverscanIsMissing) {
    const LightField field = traced(19.5f, 4, 1);
    EXPECT_EQ(missingOverscanPx(field, {0, 1}), 0);
    // Depth 1 is then 31.5 - 10.5 = 21 pixels out of focus, and 42 through a lens of twice the size.
    const float far = shiftTo(field, 3);
    EXPECT_EQ(missingOverscanPx(field, {far, 1}), 0);
    EXPECT_NEAR(missingOverscanPx(field, {far, 2}), 42 - 24, 2);
}

TEST(Refocus, refusesWhatIsNoThinLens) {
    LightField field = traced(19.5f, 1, 1);
    for (const double distance : {0.0, -1.0, std::nan("")})
        test::expectError(ErrorCode::usage, "is not positive", [&] { focusedAt(field, distance); });
    test::expectError(ErrorCode::usage, "blur is infinite", [&] { focusedAt(field, 1e-40); });
    field.samples[3].slope += 1;
    test::expectError(ErrorCode::usage, "not that of a thin lens", [&] { focusedAt(field, 2); });
    field.slopeModel = {0, 0};
    test::expectError(ErrorCode::usage, "pinhole", [&] { focusedAt(field, 2); });
}

} // namespace
} // namespace slant

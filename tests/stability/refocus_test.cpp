// A field traced once, seen through a lens focused elsewhere: as if it had been traced so.
#include "image/metrics.h"
#include "lightfield/refocus.h"
#include "reconstruct/cpu_reconstructor.h"
#include "support/expect_error.h"
#include "support/stages.h"
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

Image reconstruct(const LightField& field, Method method) {
    ReconstructOptions options;
    options.method = method;
    options.outputsPerPixel = 32;
    CpuReconstructor cpu;
    return test::run(cpu, field, options).image;
}

TEST(Refocus, isAsGoodAsTracingAgain) {
    const LightField field = traced(19.5f, 9, 1);
    for (const double distance : {1.1, 4.0}) {
        const float c2 = float(-kC1 / distance);
        const Image truth = reconstruct(traced(c2, 196, 77), Method::box);
        const double again = compare(reconstruct(traced(c2, 9, 1), Method::full), truth).relMse;
        const double moved = compare(reconstruct(refocused(field, distance), Method::full), truth).relMse;
        EXPECT_LT(moved, 2 * again) << distance;
    }
}

TEST(Refocus, keepsPinholePositionsAndFollowsTheDepths) {
    const LightField field = traced(19.5f, 3, 1);
    EXPECT_NEAR(*focusDistance(field.slopeModel), 31.5 / 19.5, 1e-6);
    for (const double distance : {0.25, 2.0, 1e9, double(INFINITY)}) {
        const LightField other = refocused(field, distance);
        EXPECT_NEAR(other.slopeModel.c2, -kC1 / distance, 1e-5);
        for (std::size_t i = 0; i < field.samples.size(); ++i) {
            const LightFieldSample &a = field.samples[i], &b = other.samples[i];
            ASSERT_EQ(b.slope, other.slopeModel(a.w));
            ASSERT_NEAR(a.x - a.slope * a.u, b.x - b.slope * b.u, 1e-4);
            ASSERT_NEAR(a.y - a.slope * a.v, b.y - b.slope * b.v, 1e-4);
        }
    }
}

TEST(Refocus, saysHowMuchOverscanIsMissing) {
    const LightField field = traced(19.5f, 4, 1);
    EXPECT_EQ(missingOverscanPx(field, 1), 0);
    // Depth 1 is then 31.5 - 10.5 = 21 pixels out of focus, and 42 through a lens of twice the size.
    const LightField far = refocused(field, 3);
    EXPECT_EQ(missingOverscanPx(far, 1), 0);
    EXPECT_NEAR(missingOverscanPx(far, 2), 42 - 24, 2);
}

TEST(Refocus, refusesWhatIsNoThinLens) {
    LightField field = traced(19.5f, 1, 1);
    for (const double distance : {0.0, -1.0, std::nan("")})
        test::expectError(ErrorCode::usage, "is not positive", [&] { refocused(field, distance); });
    field.samples[3].slope += 1;
    test::expectError(ErrorCode::usage, "not that of a thin lens", [&] { refocused(field, 2); });
    field.slopeModel = {0, 0};
    test::expectError(ErrorCode::usage, "pinhole", [&] { refocused(field, 2); });
}

} // namespace
} // namespace slant

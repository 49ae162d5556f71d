// The compute path against the CPU path, stage by stage, to the bit.
#include "compute/compute_reconstructor.h"
#include "reconstruct/cpu_reconstructor.h"
#include "reconstruct/plan.h"
#include "support/expect_error.h"
#include "support/intermediates.h"
#include "support/synthetic.h"
#include "support/vulkan_fixture.h"

#include <cmath>

namespace slant {
namespace {

using test::expectEqual;
using test::Reconstruction;

constexpr float kInfinity = std::numeric_limits<float>::infinity();
const std::vector<Method> kMethods = [] {
    std::vector<Method> methods;
    for (std::size_t i = 0; i < kMethodCount; ++i) methods.push_back(Method(i));
    return methods;
}();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

class ReconstructParity : public test::VulkanTest {
protected:
    static LightField makeField(Rect frame, int spp) {
        LightField field = synthetic::sample(synthetic::discsOverChecks(), frame, 15, spp, 7);
        EXPECT_EQ(sanitize(field).total(), 0u);
        return field;
    }

    static ReconstructOptions optionsOf(Method method, int outputsPerPixel = 16) {
        ReconstructOptions options;
        options.method = method;
        options.outputsPerPixel = outputsPerPixel;
        options.window.rangePx = 2; // fast; window_test.cpp has others
        return options;
    }

    static Reconstruction compute(const LightField& field, const ReconstructOptions& options,
                                  const LensView& view = {}) {
        ComputeReconstructor reconstructor(device());
        return test::run(reconstructor, field, options, view);
    }

    /// The compute run, after it was found equal to the CPU's and all finite.
    static Reconstruction runBoth(const LightField& field, const ReconstructOptions& options,
                                  const LensView& view = {}) {
        CpuReconstructor cpu;
        const Reconstruction expected = test::run(cpu, field, options, view);
        Reconstruction got = compute(field, options, view);
        expectEqual(expected.intermediates, got.intermediates);
        EXPECT_EQ(expected.report.emptyPixels, got.report.emptyPixels);
        EXPECT_EQ(expected.report.search.holes, got.report.search.holes);
        EXPECT_EQ(expected.report.outputs, got.report.outputs);
        EXPECT_EQ(expected.report.fromMap, got.report.fromMap);
        EXPECT_TRUE(expected.report.mapShare == got.report.mapShare);
        EXPECT_EQ(expected.report.search.visibility, got.report.search.visibility);
        EXPECT_EQ(expected.report.search.widened, got.report.search.widened);
        for (const float value : got.image.pixels) EXPECT_TRUE(std::isfinite(value));
        return got;
    }
};

TEST_F(ReconstructParity, everyStageAtOddSizes) {
    for (const Rect frame : {Rect{0, 0, 61, 43}, Rect{-7, 3, 30, 36}, Rect{5, 5, 6, 6}})
        for (const int spp : {1, 3, 8})
            for (const Method method : kMethods) {
                const LightField field = makeField(frame, spp);
                const Reconstruction once = runBoth(field, optionsOf(method));
                EXPECT_EQ(once.report.emptyPixels, 0u);
                expectEqual(once.intermediates, compute(field, optionsOf(method)).intermediates);
            }
}

TEST_F(ReconstructParity, pixelsThatDifferInTheirNumberOfSamples) {
    const Rect frame{-7, 3, 30, 36};
    for (const synthetic::Counts& counts : synthetic::varyingCounts(frame))
        for (const Method method : kMethods) {
            const LightField field = synthetic::sample(synthetic::discsOverChecks(), frame, 15, counts.at, 7);
            const Reconstruction run = runBoth(field, optionsOf(method));
            EXPECT_EQ(run.report.search.overflowed, 0u) << counts.name << ", " << nameOf(method);
        }
}

TEST_F(ReconstructParity, everyFilter) {
    const LightField field = makeField({2, 1, 43, 28}, 3);
    for (const PixelFilter& filter : {PixelFilter{FilterKind::box, {0.5f, 0.5f}},
                                      {FilterKind::triangle, {2, 1.3f}},
                                      {FilterKind::gaussian, {1.5f, 1.5f}},
                                      {FilterKind::mitchell, {2, 2}},
                                      {FilterKind::sinc, {4, 4}}})
        for (const Method method : kMethods) {
            ReconstructOptions options = optionsOf(method);
            options.filter = filter;
            runBoth(field, options);
        }
}

TEST_F(ReconstructParity, everyNumberOfOutputs) {
    const LightField field = makeField({0, 0, 21, 13}, 2);
    for (const int outputs : {1, 2, 4, 256}) {
        const Reconstruction run = runBoth(field, optionsOf(Method::full, outputs));
        EXPECT_EQ(run.report.outputs, std::uint64_t(23 * 15 * outputs));
    }
}

TEST_F(ReconstructParity, everyAperture) {
    const LightField field = makeField({0, 0, 31, 23}, 3);
    for (const float lensScale : {0.f, 0.37f, 1.5f})
        for (const Method method : {Method::window, Method::full, Method::automatic}) {
            const LensView view{.apertureScale = lensScale};
            EXPECT_EQ(runBoth(field, optionsOf(method), view).report.emptyPixels, 0u);
        }
}

TEST_F(ReconstructParity, everyShapeOfAperture) {
    const LightField field = makeField({0, 0, 21, 13}, 3);
    Image ring({0, 0, 9, 9}, {"Y"});
    for (std::size_t i = 0; i < ring.pixels.size(); ++i) ring.pixels[i] = i == 40 ? 0.f : float(i % 5);
    std::vector<ApertureShape> shapes{apertureOfImage(ring, {})};
    for (const char* name : {"disc", "star", "polygon 7 12"}) shapes.push_back(*parseAperture(name, {}));
    for (const ApertureShape& shape : shapes)
        for (const Method method : {Method::window, Method::full, Method::automatic}) {
            const LensView view{.apertureScale = 0.9f, .aperture = Aperture(shape)};
            EXPECT_EQ(runBoth(field, optionsOf(method, 32), view).report.emptyPixels, 0u);
        }
}

TEST_F(ReconstructParity, filmDoesNotDependOnMemory) {
    const LightField field = makeField({0, 0, 61, 43}, 8);
    for (const Method method : {Method::box, Method::window, Method::full}) {
        ReconstructOptions options = optionsOf(method, 64);
        const Reconstruction plenty = runBoth(field, options);
        // 6 bands of 8 rows (of `box`, 2 bands) times 2 chunks, then 2 bands (1) times 2 chunks.
        for (const auto& [bytes, denseStages] : {std::pair(700'000u, method == Method::box ? 2 : 12),
                                                 {3'000'000u, method == Method::box ? 1 : 4}}) {
            options.memoryBytes = bytes;
            const Reconstruction tight = runBoth(field, options);
            EXPECT_EQ(std::count(tight.intermediates.names.begin(), tight.intermediates.names.end(), "dense"),
                      denseStages);
            EXPECT_TRUE(plenty.intermediates.contents.back() == tight.intermediates.contents.back()) << bytes;
        }
    }
}

/// The layer map takes most of the memory; its bands follow from that.
TEST_F(ReconstructParity, layerMapDoesNotDependOnMemory) {
    const LightField field = makeField({0, 0, 61, 43}, 8);
    ReconstructOptions options = optionsOf(Method::automatic, 64);
    const Reconstruction plenty = runBoth(field, options);
    EXPECT_GT(plenty.report.fromMap, plenty.report.outputs / 10);
    for (const auto& [bytes, maps] : {std::pair(4'250'000u, 3), {4'750'000u, 2}}) {
        options.memoryBytes = bytes;
        const Reconstruction tight = runBoth(field, options);
        EXPECT_EQ(std::count(tight.intermediates.names.begin(), tight.intermediates.names.end(), "layer_map"),
                  maps);
        EXPECT_TRUE(plenty.intermediates.contents.back() == tight.intermediates.contents.back()) << bytes;
    }
    options.memoryBytes = 1'000'000;
    test::expectError(ErrorCode::resources, "layer map it has to be", [&] { compute(field, options); });
}

TEST_F(ReconstructParity, whereAllIsInFocusFewOutputsAreMade) {
    const Rect frame{0, 0, 29, 21};
    std::vector<synthetic::Layer> layers = synthetic::discsOverChecks();
    layers.erase(layers.begin());
    layers[1].slope = 0.4f;
    for (const int spp : {3, 16}) { // from the map, from the bins
        const LightField field = synthetic::sample(layers, frame, 15, spp, 7);
        const Reconstruction thin = runBoth(field, optionsOf(Method::automatic, 128));
        EXPECT_EQ(thin.report.outputs, std::uint64_t(31 * 23 * 32));
        EXPECT_EQ(thin.report.fromMap, spp == 3 ? thin.report.outputs : 0);
        const Image all = runBoth(field, optionsOf(Method::full, 128)).image;
        double difference = 0;
        for (std::size_t i = 0; i < all.pixels.size(); ++i)
            difference += std::abs(double(all.pixels[i]) - double(thin.image.pixels[i]));
        EXPECT_LT(difference / double(all.pixels.size()), spp == 3 ? 0.02 : 0.005);
    }
}

TEST_F(ReconstructParity, outputsWithTooManyCandidatesAreDoneOnTheCpu) {
    LightField field = makeField({0, 0, 24, 17}, 50);
    synthetic::Random random(3);
    for (LightFieldSample& s : field.samples) { // all in one spot, not each in its own pixel
        s.x = 11.9f + 0.2f * random.uniform();
        s.y = 7.9f + 0.2f * random.uniform();
        s.slope = random.uniform();
    }
    EXPECT_EQ(sanitize(field).total(), 0u);
    ASSERT_GT(field.samples.size(), std::size_t(kMaxLoopIterations));
    const Reconstruction run = runBoth(field, optionsOf(Method::full));
    EXPECT_GT(run.report.search.overflowed, 0u);
    EXPECT_GT(run.report.search.holes, 0u);
    EXPECT_GT(run.report.emptyPixels, 0u);

    LightField crowded = makeField({0, 0, 24, 17}, 50);
    for (std::size_t i = 0; i < crowded.samples.size(); i += 2) { // too many for a texel of the layer map
        LightFieldSample& s = crowded.samples[i];
        s.slope = 9;
        s.x = 11.9f + 0.2f * random.uniform() + s.slope * s.u;
        s.y = 7.9f + 0.2f * random.uniform() + s.slope * s.v;
    }
    EXPECT_GT(runBoth(crowded, optionsOf(Method::automatic)).report.fromMap, 0u);
}

TEST_F(ReconstructParity, sanitizedRubbishIsLeftOut) {
    LightField field = makeField({0, 0, 31, 23}, 4);
    int kind = 0;
    for (std::size_t i = 0; i < field.samples.size(); i += 3) {
        LightFieldSample& s = field.samples[i];
        switch (kind++ % 14) {
        case 0:
            field.radiance[i].r = kNaN;
            break;
        case 1:
            field.radiance[i].g = kInfinity;
            break;
        case 2:
            field.radiance[i].b = -1;
            break;
        case 3:
            s.w = 0;
            break;
        case 4:
            s.w = -2;
            break;
        case 5:
            s.w = kNaN;
            break;
        case 6:
            s.u = 1.5f;
            break;
        case 7:
            s.v = kNaN;
            break;
        case 8:
            s.slope = kInfinity;
            break;
        case 9:
            s.slope = -kInfinity;
            break;
        case 10:
            s.slope = kNaN;
            break;
        case 11:
            s.x = kNaN;
            break;
        case 12:
            s.y = -kInfinity;
            break;
        case 13:
            s.t = kNaN;
            break;
        }
    }
    EXPECT_GT(sanitize(field).total(), field.samples.size() / 4);
    for (const Method method : kMethods) runBoth(field, optionsOf(method));
}

TEST_F(ReconstructParity, hugeSlopes) {
    LightField field = makeField({0, 0, 31, 23}, 4);
    const std::vector<float> slopes = {300, -300, 1700, -5000, 5000, 1e6f, -1e9f, 1e30f, 3e38f, 1e-30f};
    for (std::size_t i = 0; i < field.samples.size(); i += 17)
        field.samples[i].slope = slopes[i / 17 % slopes.size()];
    const auto isFar = [](const LightFieldSample& s) { return std::abs(s.slope) >= 1e9f; };
    const auto far = std::uint64_t(std::ranges::count_if(field.samples, isFar));
    EXPECT_EQ(sanitize(field).badPosition, far);
    for (const Method method : kMethods) EXPECT_EQ(runBoth(field, optionsOf(method)).report.emptyPixels, 0u);
}

TEST_F(ReconstructParity, fieldsWithoutSamplesAreBlack) {
    LightField field = makeField({0, 0, 13, 9}, 2);
    for (LightFieldSample& s : field.samples) s.w = 0;
    EXPECT_EQ(sanitize(field).badDepth, field.samples.size());
    for (const Method method : kMethods) {
        const Reconstruction run = runBoth(field, optionsOf(method));
        EXPECT_EQ(run.report.emptyPixels, method == Method::window ? 0 : 13u * 9); // its holes are black
        EXPECT_EQ(std::count(run.image.pixels.begin(), run.image.pixels.end(), 0.f), 13 * 9 * 3);
    }
}

} // namespace
} // namespace slant

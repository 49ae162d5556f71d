// Fields whose pixels differ in their number of samples: no holes, no drift, and everywhere as exact as a
// field with equally many samples in all pixels.
#include "reconstruct/cpu_reconstructor.h"
#include "reconstruct/grid.h"
#include "support/intermediates.h"
#include "support/synthetic.h"

#include <numeric>

namespace slant {
namespace {

const Rect kFrame{0, 0, 128, 48};
constexpr int kOverscan = 15;
const std::vector<synthetic::Layer> kLayers = synthetic::discsOverChecks();

test::Reconstruction reconstruct(const LightField& field, Method method) {
    ReconstructOptions options;
    options.method = method;
    options.outputsPerPixel = 32;
    CpuReconstructor cpu;
    return test::run(cpu, field, options);
}

const Image& truth() {
    static const Image image =
        reconstruct(synthetic::sample(kLayers, kFrame, kOverscan, 400, 77), Method::box).image;
    return image;
}

double meanOf(const Image& image) {
    return std::accumulate(image.pixels.begin(), image.pixels.end(), 0.0) / double(image.pixels.size());
}

/// Of the columns [x0, x1).
double mse(const Image& image, int x0, int x1) {
    double sum = 0;
    for (int y = 0; y < image.height(); ++y)
        for (int x = x0; x < x1; ++x)
            for (int c = 0; c < 3; ++c) sum += std::pow(image.at(x, y, c) - truth().at(x, y, c), 2.0);
    return sum / (3.0 * image.height() * (x1 - x0));
}

TEST(Density, isTheMeanOverTheBlur) {
    const auto counts = [](int x, int) { return x < 64 ? 2 : 16; };
    const LightField field = synthetic::sample(kLayers, kFrame, kOverscan, counts, 1);
    const SampleDensity density = densityOf(SceneSideSamples(field));
    EXPECT_EQ(density.least, 2);
    EXPECT_EQ(samplesAround(density, {20, 20}, 0), 2);
    EXPECT_EQ(samplesAround(density, {20, 20}, -12), 2);
    EXPECT_EQ(samplesAround(density, {66, 20}, 0.5f), 16);
    EXPECT_EQ(samplesAround(density, {64, 20}, 9), 9);
    EXPECT_NEAR(samplesAround(density, {60, 20}, 12), 6.4, 0.2); // 6.6 of 21.3 pixels are beyond the edge
    EXPECT_EQ(samplesAround(density, {-1e6f, 1e6f}, 3), 2) << "the nearest pixels there are";
    EXPECT_EQ(radiusRatioAt(density, {20, 20}, 0, emptyCircleRadius(2)), 1);
    EXPECT_FLOAT_EQ(radiusRatioAt(density, {120, 20}, 0, emptyCircleRadius(2)), std::sqrt(8.f));
}

TEST(Density, equalCountsAreNoDifference) {
    LightField field = synthetic::sample(kLayers, {0, 0, 30, 20}, kOverscan, 3, 1);
    EXPECT_EQ(densityOf(SceneSideSamples(field)).least, 3);
    EXPECT_EQ(radiusRatioAt(densityOf(SceneSideSamples(field)), {3, 4}, 5, 0.7f), 1);
    const std::vector<std::uint32_t> counts(field.bounds.area(), 3);
    setSampleCounts(field, counts);
    EXPECT_EQ(field.samplesPerPixel, 3);
    EXPECT_TRUE(field.pixelStart.empty());
}

TEST(Density, constantRadianceStays) {
    for (const synthetic::Counts& counts : synthetic::varyingCounts(kFrame)) {
        LightField field = synthetic::sample(kLayers, {40, 0, 80, 31}, kOverscan, counts.at, 5);
        std::ranges::fill(field.radiance, glm::vec3(0.7f));
        for (const Method method : {Method::box, Method::full, Method::automatic})
            for (const float value : reconstruct(field, method).image.pixels)
                ASSERT_NEAR(value, 0.7f, method == Method::automatic ? 5e-4f : 1e-5f) // the map has 11 bits
                    << counts.name << ", " << nameOf(method);
    }
}

class DensityOfMethod : public testing::TestWithParam<Method> {};

TEST_P(DensityOfMethod, noHolesAndNoDrift) {
    for (const synthetic::Counts& counts : synthetic::varyingCounts(kFrame)) {
        double mean = 0;
        for (const std::uint32_t seed : {1, 2}) {
            const auto run =
                reconstruct(synthetic::sample(kLayers, kFrame, kOverscan, counts.at, seed), GetParam());
            EXPECT_EQ(run.report.search.holes, 0u) << counts.name;
            EXPECT_EQ(run.report.emptyPixels, 0u) << counts.name;
            mean += meanOf(run.image) / 2;
        }
        EXPECT_NEAR(mean / meanOf(truth()), 1, 0.003) << counts.name;
    }
}

/// Away from where the density changes, by the largest blur.
TEST_P(DensityOfMethod, isAsExactAsUniformFieldsOfThatDensity) {
    const auto counts = [](int x, int) { return x < 64 ? 2 : 16; };
    double sparse = 0, dense = 0, uniformSparse = 0, uniformDense = 0;
    for (const std::uint32_t seed : {1, 2, 3, 4, 5, 6}) {
        const auto imageOf = [&](const auto& spp) {
            return reconstruct(synthetic::sample(kLayers, kFrame, kOverscan, spp, seed), GetParam()).image;
        };
        const Image both = imageOf(counts), two = imageOf(2), sixteen = imageOf(16);
        sparse += mse(both, 0, 50), uniformSparse += mse(two, 0, 50);
        dense += mse(both, 78, 128), uniformDense += mse(sixteen, 78, 128);
    }
    EXPECT_LT(sparse, 1.1 * uniformSparse);
    EXPECT_LT(dense, 1.1 * uniformDense);
}

INSTANTIATE_TEST_SUITE_P(Methods, DensityOfMethod, testing::Values(Method::full, Method::automatic),
                         [](const auto& method) { return nameOf(method.param); });

} // namespace
} // namespace slant

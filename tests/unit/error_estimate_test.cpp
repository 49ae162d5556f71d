// The estimated error of a picture, and where more samples go: against noise of known strength.
#include "render/error_estimate.h"
#include "support/synthetic.h"

#include <gtest/gtest.h>
#include <numeric>

namespace slant {
namespace {

const Rect kFrame{0, 0, 128, 32};
constexpr float kMean = 0.5f;

/// A grey wall whose samples have a noise of `deviation`(x), as wide to either side.
LightField noisyWall(int spp, const std::function<float(int x)>& deviation) {
    const synthetic::Layer wall{0.f, [](glm::vec2) { return true; },
                                [](glm::vec2) { return glm::vec3(kMean); }};
    LightField field = synthetic::sample({wall}, kFrame, 2, spp, 3);
    synthetic::Random random(9);
    for (std::size_t i = 0; i < field.samples.size(); ++i) {
        const float side = random.uniform() < 0.5f ? -1.f : 1.f;
        field.radiance[i] += glm::vec3(side * deviation(int(std::floor(field.samples[i].x))));
    }
    return field;
}

ErrorEstimate estimateOf(const LightField& field) {
    Backend backend("cpu");
    ReconstructOptions options;
    options.method = Method::box;
    options.filter = {FilterKind::box, {0.5f, 0.5f}};
    SilentMonitor monitor;
    ReconstructReport report;
    std::vector<Agreement> agreements;
    return ErrorEstimate(backend, field, options, {}, false, monitor, report, agreements);
}

TEST(ErrorEstimate, isTheNoiseOfTheMean) {
    constexpr float kDeviation = 0.2f;
    for (const int spp : {4, 16}) {
        const ErrorEstimate estimate = estimateOf(noisyWall(spp, [](int) { return kDeviation; }));
        Image image(kFrame, {"R", "G", "B"});
        estimate.addChannels(image);
        EXPECT_EQ(image.channels, (std::vector<std::string>{"R", "G", "B", "error.R", "error.G", "error.B"}));
        double sum = 0;
        for (int y = 0; y < image.height(); ++y)
            for (int x = 0; x < image.width(); ++x) sum += std::pow(image.at(x, y, 4), 2);
        const double variance = kDeviation * kDeviation / spp;
        EXPECT_NEAR(sum / double(kFrame.area()) / variance, 1, 0.1);
        EXPECT_NEAR(estimate.relMse() / (variance / (kMean * kMean + 0.01)), 1, 0.15);
    }
}

TEST(ErrorEstimate, isZeroWithoutNoise) {
    const ErrorEstimate estimate = estimateOf(noisyWall(3, [](int) { return 0.f; }));
    EXPECT_EQ(estimate.relMse(), 0);
    const std::vector<std::uint32_t> before(kFrame.area(), 3);
    for (const std::uint32_t more : estimate.place(before, 1000)) EXPECT_EQ(more, 0u);
}

TEST(ErrorEstimate, placesSamplesInProportionToTheirNoise) {
    const auto deviation = [](int x) { return x < 32 ? 0.f : x < 64 ? 0.1f : x < 96 ? 0.2f : 0.3f; };
    constexpr std::uint32_t kSpp = 16;
    const ErrorEstimate estimate = estimateOf(noisyWall(kSpp, deviation));
    const std::vector<std::uint32_t> before(kFrame.area(), kSpp);
    const std::uint64_t extra = 32 * kFrame.area();
    const std::vector<std::uint32_t> more = estimate.place(before, extra);
    EXPECT_NEAR(double(std::accumulate(more.begin(), more.end(), std::uint64_t(0))), double(extra), 2);
    const auto meanOf = [&](int x0) { // of a strip, away from its sides
        double sum = 0;
        for (int y = 0; y < kFrame.height(); ++y)
            for (int x = x0 + 12; x < x0 + 20; ++x) sum += kSpp + more[std::size_t(y * kFrame.width() + x)];
        return sum / (8.0 * kFrame.height());
    };
    EXPECT_EQ(meanOf(0), kSpp);
    EXPECT_NEAR(meanOf(64) / meanOf(32), 2, 0.3);
    EXPECT_NEAR(meanOf(96) / meanOf(64), 1.5, 0.2);
}

TEST(ErrorEstimate, neverPlacesMoreThanSixteenTimesWhatIsThere) {
    const ErrorEstimate estimate = estimateOf(noisyWall(2, [](int x) { return x == 20 ? 0.4f : 0.f; }));
    const std::vector<std::uint32_t> before(kFrame.area(), 2);
    const std::vector<std::uint32_t> more = estimate.place(before, 1 << 20);
    for (const std::uint32_t count : more) EXPECT_LE(count, 30u);
    EXPECT_EQ(std::ranges::max(more), 30u);
}

} // namespace
} // namespace slant

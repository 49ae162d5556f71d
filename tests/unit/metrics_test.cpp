#include "image/metrics.h"

#include "image/heat_map.h"
#include "support/expect_error.h"

#include <cmath>
#include <functional>
#include <limits>

namespace slant {
namespace {

using test::expectError;
using testing::ElementsAre;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

Image grey(int width, std::vector<float> values) {
    Image image({0, 0, width, int(values.size()) / width}, {"Y"});
    image.pixels = std::move(values);
    return image;
}

/// Smooth, coloured, with an edge: every pixel unlike its neighbours.
Image picture() {
    Image image({10, 20, 27, 31}, {"R", "G", "B"});
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
            for (int c = 0; c < 3; ++c)
                image.at(x, y, c) = 0.2f + 0.1f * float(c) +
                                    0.3f * std::sin(0.9f * float(x + c)) * std::cos(float(y)) +
                                    (x > 8 ? 0.4f : 0.f);
    return image;
}

TEST(Metrics, valuesByHand) {
    // Errors 0.1, -0.2, 0, 0.4 against 1, 0, 0.5, 0.3.
    const Metrics m = compare(grey(2, {1.1f, -0.2f, 0.5f, 0.7f}), grey(2, {1, 0, 0.5f, 0.3f}));
    EXPECT_NEAR(m.mse, (0.01 + 0.04 + 0.16) / 4, 1e-7);
    EXPECT_NEAR(m.relMse, (0.01 / 1.01 + 0.04 / 0.01 + 0.16 / 0.10) / 4, 1e-6);
    EXPECT_NEAR(m.psnr, 12.798407, 1e-4); // -10 log10(0.0525)
    EXPECT_NEAR(m.mae, 0.175, 1e-7);
    EXPECT_NEAR(m.maxAbs, 0.4, 1e-7);
    EXPECT_NEAR(m.p99, 0.4, 1e-7);
    EXPECT_EQ(m.maxPlace.x, 1);
    EXPECT_EQ(m.maxPlace.y, 1);
    EXPECT_EQ(m.maxValue, 0.7f);
    EXPECT_EQ(m.maxReference, 0.3f);
    EXPECT_NEAR(m.drift, 2.1 / 1.8 - 1, 1e-7);
    EXPECT_EQ(m.nonFinite, 0u);
}

TEST(Metrics, equalImagesAreExact) {
    const Metrics m = compare(picture(), picture());
    EXPECT_EQ(m.mse, 0);
    EXPECT_EQ(m.relMse, 0);
    EXPECT_EQ(m.psnr, kInfinity);
    EXPECT_EQ(m.mae, 0);
    EXPECT_EQ(m.p99, 0);
    EXPECT_EQ(m.maxAbs, 0);
    EXPECT_EQ(m.drift, 0);
    EXPECT_THAT(m.channelDrift, ElementsAre(0, 0, 0));
}

TEST(Metrics, percentileIsTheNearestRank) {
    std::vector<float> values(200);
    for (int i = 0; i < 200; ++i) values[std::size_t(i)] = float((i * 37) % 200);
    EXPECT_EQ(compare(grey(200, values), grey(200, std::vector<float>(200))).p99,
              197); // 198 of 200 are <= 197
    EXPECT_EQ(compare(grey(1, {3}), grey(1, {1})).p99, 2);
}

TEST(Metrics, driftIsSignedAndPerChannel) {
    const Image reference = picture();
    Image image = reference;
    for (std::size_t i = 1; i < image.pixels.size(); i += 3) image.pixels[i] *= 0.5f;
    const Metrics m = compare(image, reference);
    EXPECT_EQ(m.channelDrift[0], 0);
    EXPECT_NEAR(m.channelDrift[1], -0.5, 1e-6);
    EXPECT_EQ(m.channelDrift[2], 0);
    EXPECT_LT(m.drift, -0.1);
    EXPECT_EQ(compare(grey(1, {1}), grey(1, {0})).drift, kInfinity);
    EXPECT_EQ(compare(grey(1, {0}), grey(1, {0})).drift, 0);
}

TEST(Metrics, worstPlaceIsInFilmCoordinates) {
    const Image reference = picture();
    Image image = reference;
    image.at(16, 10, 2) += 5;
    const Metrics m = compare(image, reference);
    EXPECT_EQ(m.maxPlace.x, 26);
    EXPECT_EQ(m.maxPlace.y, 30);
    EXPECT_EQ(m.maxPlace.channel, 2);
}

TEST(Metrics, nonFiniteLeavesNoFigureThatCouldPass) {
    const Image good = picture();
    for (const float bad : {kNaN, kInfinity, -kInfinity}) {
        Image image = good;
        image.at(2, 3, 1) = bad;
        image.at(5, 3, 0) = bad;
        for (const Metrics& m : {compare(image, good), compare(good, image), compare(image, image)}) {
            EXPECT_GE(m.nonFinite, 2u);
            EXPECT_EQ(m.nonFinitePlace.x, 12);
            EXPECT_EQ(m.nonFinitePlace.y, 23);
            EXPECT_EQ(m.nonFinitePlace.channel, 1);
            for (const double figure :
                 {m.mse, m.relMse, m.psnr, m.mae, m.p99, m.maxAbs, m.drift, m.channelDrift[2]})
                EXPECT_TRUE(std::isnan(figure));
        }
    }
}

TEST(Metrics, unlikeImagesAreRefused) {
    const Image a = Image::rgb(3, 2);
    expectError(ErrorCode::badInput, "3x2 and 2x3", [&] { compare(a, Image::rgb(2, 3)); });
    expectError(ErrorCode::badInput, "R G B and B G R", [&] {
        compare(a, Image(a.dataWindow, {"B", "G", "R"}));
    });
    expectError(ErrorCode::badInput, "(0, 0) and (1, 0)", [&] {
        compare(a, Image({1, 0, 4, 2}, a.channels));
    });
    expectError(ErrorCode::badInput, "without pixels", [] { compare(Image(), Image()); });
}

/// Wrong pictures that a comparison must not accept.
std::vector<std::pair<std::string, Image>> impostors(const Image& truth) {
    const auto changed = [&](const std::function<void(Image&)>& change) {
        Image image = truth;
        change(image);
        return image;
    };
    const float mean = [&] {
        double sum = 0;
        for (const float value : truth.pixels) sum += value;
        return float(sum / double(truth.pixels.size()));
    }();
    return {{"zero", changed([](Image& i) { std::fill(i.pixels.begin(), i.pixels.end(), 0.f); })},
            {"NaN", changed([](Image& i) { std::fill(i.pixels.begin(), i.pixels.end(), kNaN); })},
            {"constant", changed([&](Image& i) { std::fill(i.pixels.begin(), i.pixels.end(), mean); })},
            {"shifted",
             changed([](Image& i) { std::rotate(i.pixels.begin(), i.pixels.begin() + 3, i.pixels.end()); })},
            {"swapped", changed([](Image& i) {
                 for (std::size_t p = 0; p < i.pixels.size(); p += 3) std::swap(i.pixels[p], i.pixels[p + 2]);
             })}};
}

TEST(Metrics, everyErrorFigureRejectsImpostors) {
    const Image truth = picture();
    for (const auto& [name, impostor] : impostors(truth)) {
        const Metrics m = compare(impostor, truth);
        EXPECT_FALSE(m.mse <= 1e-3) << name;
        EXPECT_FALSE(m.relMse <= 1e-2) << name;
        EXPECT_FALSE(m.psnr >= 30) << name;
        EXPECT_FALSE(m.mae <= 1e-2) << name;
        EXPECT_FALSE(m.maxAbs <= 0.1) << name;
        EXPECT_FALSE(m.p99 <= 0.1) << name;
    }
}

TEST(HeatMap, coloursRiseWithTheErrorAndNonFiniteIsGreen) {
    const int width = 40;
    const Image reference({0, 0, width, 1}, {"R", "G"});
    Image image = reference;
    for (int x = 0; x < width; ++x)
        image.at(x, 0, x % 2) = (x % 3 ? 1.f : -1.f) * float(x) / float(width - 1);
    const Bitmap map = heatMap(image, reference, 1);
    double previous = -1;
    for (std::size_t i = 0; i < map.bytes.size(); i += 3) {
        const double luminance =
            0.2126 * map.bytes[i] + 0.7152 * map.bytes[i + 1] + 0.0722 * map.bytes[i + 2];
        EXPECT_GT(luminance, previous) << i / 3;
        previous = luminance;
    }
    const auto color = [](float value, double scale) {
        return heatMap(grey(1, {value}), grey(1, {0}), scale).bytes;
    };
    EXPECT_THAT(color(0, 1), ElementsAre(0, 0, 4));
    EXPECT_THAT(color(1, 4), ElementsAre(81, 18, 124));
    EXPECT_THAT(color(7, 1), ElementsAre(252, 253, 191));
    EXPECT_THAT(color(kNaN, 1), ElementsAre(0, 255, 0));
    EXPECT_THAT(color(-kInfinity, 1), ElementsAre(0, 255, 0));
}

} // namespace
} // namespace slant

// Shapes of apertures: their areas and outlines are known, and lens positions are spread over them as light
// passes.
#include "camera/aperture.h"
#include "support/expect_error.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

namespace slant {
namespace {

using glm::vec2;

/// A picture with `side` pixels per side.
template <typename Value>
Image picture(int side, const Value& value) {
    Image image({0, 0, side, side}, {"Y"});
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) image.at(x, y, 0) = value(x, y);
    return image;
}

Aperture apertureOf(const std::string& text) {
    return Aperture(parseAperture(text, {}).value());
}

/// With a hole, of two brightnesses.
Aperture ring() {
    return Aperture(apertureOfImage(picture(64,
                                            [](int x, int y) {
                                                const double r = std::hypot(x - 31.5, y - 31.5) / 32;
                                                return r < 0.6 || r > 0.95 ? 0.f : x < 20 ? 0.3f : 1.f;
                                            }),
                                    {}));
}

std::vector<Aperture> allShapes() {
    std::vector<Aperture> shapes{ring()};
    for (const char* name : {"disc", "gaussian", "square", "pentagon", "star", "polygon 3", "polygon 4 10",
                             "polygon 6 -15.5", "polygon 7", "polygon 9 200", "polygon 100"})
        shapes.push_back(apertureOf(name));
    return shapes;
}

constexpr int kBins = 16;

/// The share of a lens's light in each of kBins x kBins parts of [-1, 1]^2.
template <typename Add>
std::vector<double> shares(const Add& add) {
    std::vector<double> sums(kBins * kBins);
    double total = 0;
    add([&](vec2 p, double weight) {
        const glm::ivec2 bin = glm::clamp(glm::ivec2(glm::floor((p + 1.f) * float(kBins / 2))), 0, kBins - 1);
        sums[std::size_t(bin.y * kBins + bin.x)] += weight;
        total += weight;
    });
    for (double& sum : sums) sum /= total;
    return sums;
}

TEST(Aperture, positionsAreSpreadAsLightPasses) {
    constexpr int kSteps = 500, kFine = 1024;
    for (const Aperture& aperture : allShapes()) {
        const auto got = shares([&](const auto& add) {
            for (int j = 0; j < kSteps; ++j)
                for (int i = 0; i < kSteps; ++i) {
                    const vec2 p = aperture.at((vec2(i, j) + 0.5f) * (2.f / kSteps) - 1.f);
                    ASSERT_LE(glm::length(p), 1 + 1e-6f);
                    add(p, 1);
                }
        });
        const auto expected = shares([&](const auto& add) {
            for (int j = 0; j < kFine; ++j)
                for (int i = 0; i < kFine; ++i) {
                    const vec2 p = (vec2(i, j) + 0.5f) * (2.f / kFine) - 1.f;
                    add(p, double(aperture.transmission(p)));
                }
        });
        double difference = 0;
        for (std::size_t i = 0; i < got.size(); ++i) {
            difference += std::abs(got[i] - expected[i]) / 2;
            EXPECT_NEAR(got[i], expected[i], 4e-4) << aperture.shape().name << " part " << i;
        }
        EXPECT_LT(difference, 0.01) << aperture.shape().name;
    }
}

TEST(Aperture, positionsAreWhereLightPasses) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> unit(-1, 1);
    for (const Aperture& aperture : allShapes())
        for (int i = 0; i < 2000; ++i) {
            // Slightly inwards: rounding may put a place on the rim outside.
            const vec2 square = 0.9999f * vec2(unit(random), unit(random));
            EXPECT_GT(aperture.transmission(aperture.at(square)), 0) << aperture.shape().name;
        }
}

TEST(Aperture, areasAreKnown) {
    constexpr double pi = std::numbers::pi;
    for (const int blades : {3, 4, 5, 6, 100})
        EXPECT_NEAR(apertureOf(fmt::format("polygon {} 33", blades)).meanTransmission(),
                    blades / 2.0 * std::sin(2 * pi / blades) / pi, 1e-12);
    EXPECT_EQ(apertureOf("disc").meanTransmission(), 1);
    EXPECT_NEAR(apertureOf("square").meanTransmission(), 1 / pi, 1e-12);
    EXPECT_NEAR(apertureOf("pentagon").meanTransmission(), 0.64 * 2.5 * std::sin(0.4 * pi) / pi, 1e-12);
    EXPECT_NEAR(apertureOf("star").meanTransmission(),
                5 * std::cos(0.4 * pi) / std::cos(0.2 * pi) * std::sin(0.2 * pi) / pi, 1e-12);
    // (integral of exp(-r^2) - 1/e over the disc) / (pi (1 - 1/e))
    EXPECT_NEAR(apertureOf("gaussian").meanTransmission(), (1 - 2 / std::exp(1.0)) / (1 - std::exp(-1.0)),
                2e-3);
    for (const Aperture& aperture : allShapes()) {
        constexpr int kFine = 800;
        double sum = 0;
        for (int j = 0; j < kFine; ++j)
            for (int i = 0; i < kFine; ++i)
                sum += double(aperture.transmission((vec2(i, j) + 0.5f) * (2.f / kFine) - 1.f));
        EXPECT_NEAR(aperture.meanTransmission(), sum * 4 / (kFine * kFine) / pi, 2e-3)
            << aperture.shape().name;
    }
}

TEST(Aperture, standsUpright) {
    const Aperture triangle = apertureOf("polygon 3");
    EXPECT_EQ(triangle.transmission({0, -0.99f}), 1);
    EXPECT_EQ(triangle.transmission({0, 0.51f}), 0);
    EXPECT_EQ(triangle.transmission({0.5f, 0.49f}), 1);
    const Aperture turned = apertureOf("polygon 3 90"); // counter-clockwise: its top points to the left
    EXPECT_EQ(turned.transmission({-0.99f, 0}), 1);
    EXPECT_EQ(turned.transmission({0.51f, 0}), 0);
    // pbrt's pentagon stands on its tip, the square has sides of 1, the star points to the left.
    EXPECT_EQ(apertureOf("pentagon").transmission({0, 0.79f}), 1);
    EXPECT_EQ(apertureOf("pentagon").transmission({0, -0.66f}), 0);
    EXPECT_EQ(apertureOf("square").transmission({0.49f, -0.49f}), 1);
    EXPECT_EQ(apertureOf("square").transmission({0.51f, 0}), 0);
    EXPECT_EQ(apertureOf("star").transmission({-0.98f, 0}), 1);
    EXPECT_EQ(apertureOf("star").transmission({0.39f, 0}), 0);
    // The left upper quarter of an image.
    const Aperture image(
        apertureOfImage(picture(3, [](int x, int y) { return x + y == 0 ? 5.f : 0.f; }), {}));
    EXPECT_EQ(image.transmission({-0.4f, -0.5f}), 1);
    EXPECT_EQ(image.transmission({0.4f, -0.5f}), 0);
    EXPECT_EQ(image.transmission({-0.4f, 0.5f}), 0);
}

TEST(Aperture, boxesEnclosePositions) {
    std::mt19937 random(2);
    std::uniform_real_distribution<float> unit(-1, 1);
    for (const Aperture& aperture : allShapes())
        for (int k = 0; k < 60; ++k) {
            const vec2 a(unit(random), unit(random)), b(unit(random), unit(random));
            vec2 low = k == 0 ? vec2(-1) : glm::min(a, b), high = k == 0 ? vec2(1) : glm::max(a, b);
            if (aperture.isDisc()) high = low + vec2(std::min(high.x - low.x, high.y - low.y));
            const LensBox box = aperture.box(low, high);
            vec2 seenMin(2), seenMax(-2);
            for (int i = 0; i < 1600; ++i) {
                const vec2 part = (vec2(i % 40, i / 40) + 0.01f) / 39.5f;
                const vec2 p = aperture.at(glm::min(low + part * (high - low), vec2(0.9999999f)));
                EXPECT_TRUE(glm::all(glm::greaterThanEqual(p, box.min)) &&
                            glm::all(glm::lessThanEqual(p, box.max)))
                    << aperture.shape().name;
                seenMin = glm::min(seenMin, p);
                seenMax = glm::max(seenMax, p);
            }
            if (!aperture.shape().rim.empty()) { // exactly
                EXPECT_LT(glm::length(seenMin - box.min), 0.08f) << aperture.shape().name;
                EXPECT_LT(glm::length(seenMax - box.max), 0.08f) << aperture.shape().name;
            }
        }
}

TEST(Aperture, textNamesTheSameShape) {
    for (const Aperture& aperture : allShapes()) {
        const Aperture again = apertureOf(textOf(aperture.shape()));
        EXPECT_EQ(again.shape().name, aperture.shape().name);
        EXPECT_TRUE(std::ranges::equal(again.table(), aperture.table())) << aperture.shape().name;
    }
    EXPECT_EQ(apertureOf("polygon  6   0").shape().name, "polygon 6");
    EXPECT_FALSE(parseAperture("hexagon", {}));
}

TEST(Aperture, imagesOfAnySizeMeanTheSame) {
    const auto half = [](int side) {
        return Aperture(
            apertureOfImage(picture(side, [=](int x, int) { return 2 * x < side ? 1.f : 0.5f; }), {}));
    };
    for (const int side : {2, 300, 1024}) {
        const Aperture aperture = half(side);
        EXPECT_EQ(aperture.transmission({-0.5f, 0}), 1) << side;
        EXPECT_NEAR(aperture.transmission({0.5f, 0}), 0.5f, 0.003f) << side;
        EXPECT_NEAR(aperture.meanTransmission(), 0.75, 0.01) << side;
    }
}

TEST(Aperture, refusesWhatLetsNothingThrough) {
    const FileLocation where{"s.pbrt", 3, 7};
    const auto refuses = [&](const std::string& text, const std::string& part) {
        test::expectError(ErrorCode::badInput, part, [&] { parseAperture(text, where); });
    };
    for (const char* text : {"polygon", "polygon 2", "polygon 101", "polygon 5 x", "polygon 5 361",
                             "polygon 5 1 1", "polygon 5.5", "polygon 6 nan"})
        refuses(text, "s.pbrt:3:7: aperture \"" + std::string(text) + "\" is not \"polygon BLADES\"");
    std::string weights = textOf(ring().shape());
    refuses(weights + "0", "131072");
    refuses("image 00", "131072");
    weights[20] = 'g';
    refuses(weights, "hexadecimal");
    refuses("image " + std::string(131072, '0'), "fully open");

    const auto refusesImage = [&](const Image& image) {
        test::expectError(ErrorCode::badInput, "s.pbrt:3:7: the image of the aperture is black",
                          [&] { apertureOfImage(image, where); });
    };
    refusesImage(picture(5, [](int, int) { return 0.f; }));
    refusesImage(picture(5, [](int, int) { return -1.f; }));
    refusesImage(picture(40, [](int x, int y) { return x < 4 && y < 4 ? 1.f : 0.f; })); // beside the disc
}

} // namespace
} // namespace slant

// FLIP against the paper, with values worked out by hand from its formulas.
#include "image/flip.h"

#include "support/expect_error.h"

#include <array>
#include <cmath>
#include <functional>
#include <limits>

namespace slant {
namespace {

using test::expectError;

Image filled(int width, int height, std::array<float, 3> rgb) {
    Image image = Image::rgb(width, height);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = rgb[i % 3];
    return image;
}

Image painted(int width, int height, const std::function<float(int x, int y)>& grey) {
    Image image = Image::rgb(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c) image.at(x, y, c) = grey(x, y);
    return image;
}

/// Reproducible noise around `mean`, colours apart.
Image noisy(int width, int height, float mean, float amplitude, unsigned seed) {
    Image image = Image::rgb(width, height);
    unsigned state = seed;
    for (float& value : image.pixels) {
        state = state * 1664525u + 1013904223u;
        value = mean + amplitude * (float(state >> 8) * 0x1p-23f - 1);
    }
    return image;
}

/// Section 4.1.3: a Hunt-adjusted HyAB distance of constant pictures onto [0, 1]. The largest distance,
/// green to blue, follows from L*a*b* of the sRGB primaries (87.735, -86.18, 83.18) and (32.297, 79.19,
/// -107.86).
double remapped(double distance) {
    const double green[] = {87.7351, 0.877351 * -86.1829, 0.877351 * 83.1795},
                 blue[] = {32.2957, 0.322957 * 79.1855, 0.322957 * -107.8573};
    const double largest = green[0] - blue[0] + std::hypot(green[1] - blue[1], green[2] - blue[2]);
    const double power = std::pow(distance / largest, 0.7);
    return power < 0.4 ? 0.95 / 0.4 * power : 0.95 + (power - 0.4) / 0.6 * 0.05;
}

/// CIE L* of a grey.
double lightness(double y) {
    return y > 216.0 / 24389 ? 116 * std::cbrt(y) - 16 : y * 24389 / 27;
}

TEST(Flip, equalPicturesAreZero) {
    const Image image = noisy(40, 23, 0.5f, 0.4f, 1);
    const Flip result = flip(image, image);
    EXPECT_EQ(result.mean, 0);
    for (const float value : result.map.pixels) EXPECT_EQ(value, 0);
    EXPECT_EQ(result.map.width(), 40);
    EXPECT_EQ(result.map.height(), 23);
}

TEST(Flip, isSymmetricToTheBit) {
    const Image a = noisy(31, 17, 0.4f, 0.4f, 1), b = noisy(31, 17, 0.6f, 0.3f, 2);
    EXPECT_TRUE(flip(a, b).map.pixels == flip(b, a).map.pixels);
}

TEST(Flip, blackAgainstWhiteIsNearlyOne) {
    // A distance of 100 in L* alone.
    const double expected = remapped(100);
    EXPECT_NEAR(expected, 0.9674, 1e-4);
    EXPECT_NEAR(flip(filled(20, 20, {0, 0, 0}), filled(20, 20, {1, 1, 1})).mean, expected, 1e-5);
}

TEST(Flip, greenAgainstBlueIsOne) {
    EXPECT_NEAR(flip(filled(9, 9, {0, 1, 0}), filled(9, 9, {0, 0, 1})).mean, 1, 1e-6);
}

TEST(Flip, constantGreysFollowFromLightnessAlone) {
    for (const auto& [a, b] : {std::pair(0.18f, 0.2f), {0.5f, 0.9f}, {0.001f, 0.004f}, {0.3f, 0.3001f}}) {
        const double expected = remapped(std::abs(lightness(double(a)) - lightness(double(b))));
        EXPECT_NEAR(flip(filled(12, 12, {a, a, a}), filled(12, 12, {b, b, b})).mean, expected, 2e-5) << a;
    }
}

TEST(Flip, staysWithinZeroAndOne) {
    for (unsigned seed = 1; seed < 6; ++seed) {
        const Flip result = flip(noisy(30, 30, 0.5f, 3, seed), noisy(30, 30, 0.5f, 3, seed + 100));
        for (const float value : result.map.pixels) {
            EXPECT_GE(value, 0);
            EXPECT_LE(value, 1);
        }
        EXPECT_GT(result.mean, 0);
    }
}

TEST(Flip, edgesCountMoreThanTheirColour) {
    // The same small difference of colour at every pixel; in one pair it makes an edge, in the other none.
    const auto step = [](float amplitude) {
        return painted(64, 32, [=](int x, int) { return 0.5f + (x < 32 ? -amplitude : amplitude); });
    };
    const Image flat = step(0);
    const double edge = flip(step(0.05f), flat).map.at(30, 16, 0);
    const double plain = flip(filled(64, 32, {0.45f, 0.45f, 0.45f}), flat).map.at(30, 16, 0);
    EXPECT_GT(edge, plain); // though the spatial filter has already weakened the colour there
    const double far = flip(step(0.05f), flat).map.at(8, 16, 0);
    EXPECT_NEAR(far, plain, 1e-4);
}

TEST(Flip, aStepIsAnEdgeOfKnownStrength) {
    // On the first white column all positive taps of the edge detector see white and all negative ones black:
    // a magnitude of 1. The spatial filter of luminance leaves there half of the white and half its own
    // central tap.
    const Image half = painted(80, 40, [](int x, int) { return x < 40 ? 0.f : 1.f; });
    const Flip result = flip(half, filled(80, 40, {0, 0, 0}));
    double taps = 0;
    for (int x = -10; x <= 10; ++x) {
        const double degrees = x / kFlipPixelsPerDegree;
        taps += std::exp(-M_PI * M_PI * degrees * degrees / 0.0047);
    }
    const double color = remapped(lightness((1 + 1 / taps) / 2));
    const double feature = std::pow(1 / std::sqrt(2.0), 0.5);
    EXPECT_NEAR(result.map.at(40, 20, 0), std::pow(color, 1 - feature), 1e-5);
    EXPECT_NEAR(result.map.at(70, 20, 0), remapped(100), 1e-5);
    EXPECT_EQ(result.map.at(5, 20, 0), 0);
}

TEST(Flip, findsPointsAndLines) {
    const Image black = filled(41, 41, {0, 0, 0});
    const Image point = painted(41, 41, [](int x, int y) { return x == 20 && y == 20 ? 1.f : 0.f; });
    const Image line = painted(41, 41, [](int x, int) { return x == 20 ? 1.f : 0.f; });
    const Flip ofPoint = flip(point, black), ofLine = flip(line, black);
    EXPECT_GT(ofPoint.map.at(20, 20, 0), 0.2);
    EXPECT_GT(ofLine.map.at(20, 20, 0), ofPoint.map.at(20, 20, 0));
    EXPECT_EQ(ofPoint.map.at(2, 2, 0), 0);
    EXPECT_GT(ofLine.mean, ofPoint.mean);
}

TEST(Flip, followsFlippingAndTurningThePictures) {
    const Image a = noisy(29, 29, 0.5f, 0.4f, 5), b = noisy(29, 29, 0.5f, 0.4f, 6);
    const auto turned = [](const Image& image) {
        Image result = image;
        for (int y = 0; y < 29; ++y)
            for (int x = 0; x < 29; ++x)
                for (int c = 0; c < image.channelCount(); ++c) result.at(x, y, c) = image.at(28 - y, x, c);
        return result;
    };
    const Flip upright = flip(a, b), other = flip(turned(a), turned(b));
    const Image expected = turned(upright.map);
    for (std::size_t i = 0; i < expected.pixels.size(); ++i)
        EXPECT_NEAR(other.map.pixels[i], expected.pixels[i], 1e-5);
}

TEST(Flip, fineNoiseVanishesFromAfar) {
    const Image a = noisy(64, 64, 0.5f, 0.3f, 7), b = noisy(64, 64, 0.5f, 0.3f, 8);
    double last = 1;
    for (const double pixelsPerDegree : {10.0, 20.0, 40.0, 80.0}) {
        const double mean = flip(a, b, {.pixelsPerDegree = pixelsPerDegree}).mean;
        EXPECT_LT(mean, last) << pixelsPerDegree;
        last = mean;
    }
    EXPECT_NEAR(kFlipPixelsPerDegree, 67.02, 0.01);
}

TEST(Flip, growsWithTheError) {
    const Image clean = filled(48, 48, {0.5f, 0.5f, 0.5f});
    double last = 0;
    for (const float amplitude : {0.02f, 0.05f, 0.1f, 0.2f, 0.4f}) {
        const double mean = flip(noisy(48, 48, 0.5f, amplitude, 3), clean).mean;
        EXPECT_GT(mean, last);
        last = mean;
    }
}

TEST(Flip, exposureScalesBeforeClipping) {
    const Image dark = noisy(20, 20, 0.1f, 0.05f, 1), other = noisy(20, 20, 0.1f, 0.05f, 2);
    const auto times = [](Image image, float factor) {
        for (float& value : image.pixels) value *= factor;
        return image;
    };
    EXPECT_TRUE(flip(times(dark, 4), times(other, 4)).map.pixels ==
                flip(dark, other, {.exposureStops = 2}).map.pixels);
    EXPECT_EQ(flip(filled(5, 5, {2, 3, 4}), filled(5, 5, {9, 9, 9})).mean, 0); // both shown as white
}

TEST(Flip, greyIsShownAsGrey) {
    const auto grey = [](float value) {
        Image image({0, 0, 8, 8}, {"Y", "A"});
        for (std::size_t i = 0; i < image.pixels.size(); i += 2) image.pixels[i] = value;
        return image;
    };
    EXPECT_EQ(flip(grey(0.2f), grey(0.4f)).mean,
              flip(filled(8, 8, {0.2f, 0.2f, 0.2f}), filled(8, 8, {0.4f, 0.4f, 0.4f})).mean);
}

TEST(Flip, nonFiniteValuesGiveNoFigure) {
    const Image good = filled(6, 6, {0.5f, 0.5f, 0.5f});
    for (const float bad :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        Image image = good;
        image.at(2, 3, 1) = bad;
        EXPECT_TRUE(std::isnan(flip(image, good).mean));
        EXPECT_TRUE(std::isnan(flip(good, image).map.pixels[0]));
    }
}

TEST(Flip, unlikePicturesAreRefused) {
    expectError(ErrorCode::badInput, "cannot be compared", [] { flip(Image::rgb(4, 4), Image::rgb(4, 5)); });
    expectError(ErrorCode::badInput, "without pixels", [] { flip(Image::rgb(0, 0), Image::rgb(0, 0)); });
}

} // namespace
} // namespace slant

#include "image/png.h"

#include "image/srgb.h"
#include "support/expect_error.h"
#include "support/make_png.h"
#include "support/temp_dir.h"

#include <limits>
#include <random>

namespace slant {
namespace {

using test::expectError;
using test::makePng;
using test::pngChunk;
using test::TempDir;
using test::writeText;
using testing::ElementsAre;

Image readBytes(const std::string& bytes) {
    const TempDir dir;
    writeText(dir.file("a.png"), bytes);
    return readPng(dir.file("a.png"));
}

/// A byte string from numbers.
std::string raw(std::initializer_list<int> values) {
    std::string bytes;
    for (const int value : values) bytes += char(value);
    return bytes;
}

TEST(Srgb, matchesTheStandard) {
    EXPECT_EQ(srgbFromLinear(0), 0);
    EXPECT_FLOAT_EQ(srgbFromLinear(1), 1);
    EXPECT_NEAR(srgbFromLinear(0.18f), 0.46135613f, 1e-6);
    EXPECT_NEAR(linearFromSrgb(0.5f), 0.21404114f, 1e-6);
    for (int i = 0; i < 256; ++i) {
        const float encoded = float(i) / 255;
        EXPECT_EQ(std::lround(255 * srgbFromLinear(linearFromSrgb(encoded))), i);
    }
}

TEST(Png, readsGreyOfEveryDepth) {
    const Image one = readBytes(makePng(3, 1, 1, 0, raw({0, 0b10100000})));
    EXPECT_THAT(one.channels, ElementsAre("Y"));
    EXPECT_THAT(one.pixels, ElementsAre(1, 0, 1));
    EXPECT_THAT(readBytes(makePng(2, 1, 4, 0, raw({0, 0x3f}))).pixels, ElementsAre(51 / 255.f, 1));
    EXPECT_THAT(readBytes(makePng(1, 2, 8, 0, raw({0, 7, 0, 255}))).pixels, ElementsAre(7 / 255.f, 1));
    EXPECT_THAT(readBytes(makePng(1, 1, 16, 0, raw({0, 0x12, 0x34}))).pixels, ElementsAre(0x1234 / 65535.f));
}

TEST(Png, readsColourAlphaAndPalettes) {
    const Image rgb = readBytes(makePng(1, 1, 8, 2, raw({0, 1, 2, 3})));
    EXPECT_THAT(rgb.channels, ElementsAre("R", "G", "B"));
    EXPECT_THAT(rgb.pixels, ElementsAre(1 / 255.f, 2 / 255.f, 3 / 255.f));
    const Image rgba = readBytes(makePng(1, 1, 16, 6, raw({0, 0, 1, 0, 2, 0, 3, 255, 255})));
    EXPECT_THAT(rgba.channels, ElementsAre("R", "G", "B", "A"));
    EXPECT_THAT(rgba.pixels, ElementsAre(1 / 65535.f, 2 / 65535.f, 3 / 65535.f, 1));
    EXPECT_THAT(readBytes(makePng(1, 1, 8, 4, raw({0, 9, 8}))).channels, ElementsAre("Y", "A"));
    const std::string palette = pngChunk("PLTE", raw({10, 20, 30, 40, 50, 60}));
    EXPECT_THAT(readBytes(makePng(2, 1, 8, 3, raw({0, 1, 0}), palette)).pixels,
                ElementsAre(40 / 255.f, 50 / 255.f, 60 / 255.f, 10 / 255.f, 20 / 255.f, 30 / 255.f));
    const Image transparent =
        readBytes(makePng(1, 1, 8, 3, raw({0, 1}), palette + pngChunk("tRNS", raw({9, 8}))));
    EXPECT_THAT(transparent.pixels, ElementsAre(40 / 255.f, 50 / 255.f, 60 / 255.f, 8 / 255.f));
}

TEST(Png, bitmapRoundTripIsExact) {
    const TempDir dir;
    std::mt19937 random(5);
    for (const int channels : {1, 3}) {
        Bitmap bitmap{13, 7, channels, {}};
        for (int i = 0; i < 13 * 7 * channels; ++i) bitmap.bytes.push_back(std::uint8_t(random()));
        writePng(dir.file("a.png"), bitmap);
        const Image image = readPng(dir.file("a.png"));
        ASSERT_EQ(image.channelCount(), channels);
        ASSERT_EQ(image.width(), 13);
        for (std::size_t i = 0; i < bitmap.bytes.size(); ++i)
            ASSERT_EQ(std::lround(image.pixels[i] * 255), bitmap.bytes[i]);
    }
    EXPECT_EQ(dir.entries(), 1u);
}

TEST(Png, toSrgb8EncodesExposesAndClips) {
    Image image = Image::rgb(2, 1);
    image.pixels = {
        0.18f, -1, 2, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 1};
    EXPECT_THAT(toSrgb8(image).bytes, ElementsAre(118, 0, 255, 0, 255, 255));
    EXPECT_EQ(toSrgb8(image, 1).bytes[0], std::lround(255 * srgbFromLinear(0.36f)));
    Image depth({0, 0, 1, 1}, {"Z"});
    depth.pixels = {1};
    EXPECT_EQ(toSrgb8(depth).channels, 1);
    EXPECT_THAT(toSrgb8(depth).bytes, ElementsAre(255));
}

TEST(Png, hostileFilesAreRefused) {
    const TempDir dir;
    const std::string path = dir.file("a.png");
    const auto expectRefused = [&](const std::string& bytes, const std::string& part) {
        writeText(path, bytes);
        expectError(ErrorCode::badInput, part, [&] { readPng(path); });
    };
    const std::string good = makePng(3, 2, 8, 0, raw({0, 1, 2, 3, 0, 4, 5, 6}));
    for (std::size_t size = 0; size < good.size(); ++size) expectRefused(good.substr(0, size), path);
    expectRefused("GIF89a and more", "is not a PNG file");
    expectRefused(makePng(0, 2, 8, 0, raw({0})), "damaged");
    expectRefused(makePng(1000000, 1000000, 8, 2, raw({0})), "2^27");
    expectRefused(makePng(0x7fffffff, 0x7fffffff, 16, 6, raw({0})), path);
    expectRefused(makePng(10000, 10000, 8, 2, raw({0})), "too short");
    expectRefused(makePng(3, 3, 8, 0, raw({0, 1, 2, 3})), "damaged"); // too few rows
    expectRefused(makePng(1, 1, 8, 3, raw({0, 1})), path);            // no palette
    expectRefused(makePng(1, 1, 7, 2, raw({0, 1, 1, 1})), "damaged");
    std::string wrongSum = good;
    wrongSum[wrongSum.size() - 20] ^= 1;
    expectRefused(wrongSum, "damaged");
    expectError(ErrorCode::badInput, "no such file", [&] { readPng(dir.file("none.png")); });
    expectError(ErrorCode::resources, "/dev/full", [] { writePng("/dev/full", {1, 1, 1, {0}}); });
}

} // namespace
} // namespace slant

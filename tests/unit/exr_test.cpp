#include "image/exr.h"

#include "support/expect_error.h"
#include "support/temp_dir.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

namespace slant {
namespace {

using test::expectError;
using test::readText;
using test::TempDir;
using test::writeText;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

bool sameBits(const std::vector<float>& a, const std::vector<float>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

/// Every exponent and sign, denormals and specials among them.
Image wildImage(Rect window, std::vector<std::string> channels) {
    Image image(window, std::move(channels));
    std::mt19937 random(7);
    for (float& value : image.pixels) value = std::bit_cast<float>(std::uint32_t(random()));
    image.pixels[0] = -0.f;
    image.pixels[1] = kInfinity;
    image.pixels[2] = std::numeric_limits<float>::denorm_min();
    return image;
}

TEST(Exr, floatRoundTripIsExact) {
    const TempDir dir;
    Image image =
        wildImage({-3, 5, 10, 42}, {"R", "G", "B", "A", "Y", "Z", "albedo.R", "albedo.G", "albedo.B"});
    image.displayWindow = {0, 0, 20, 50};
    const Metadata metadata = {
        {"slant:method", "full"}, {"slant:spp", 8}, {"slant:seconds", 1.25f}, {"comment", ""}};
    writeExr(dir.file("a.exr"), image, metadata, ExrPrecision::float32);
    const ExrFile read = readExr(dir.file("a.exr"));
    EXPECT_EQ(read.image.dataWindow, image.dataWindow);
    EXPECT_EQ(read.image.displayWindow, image.displayWindow);
    EXPECT_EQ(read.image.channels, image.channels);
    EXPECT_TRUE(sameBits(read.image.pixels, image.pixels));
    EXPECT_EQ(read.metadata, metadata);
    EXPECT_EQ(dir.entries(), 1u);
}

TEST(Exr, halfRoundsToNearestEvenAndSaturates) {
    const TempDir dir;
    // Half has 11 significant bits: between 2048 and 4096 only even integers.
    const std::vector<std::pair<float, float>> cases = {
        {2049, 2048},   {2051, 2052},           {2049.001f, 2050},        {0.1f, 0.0999755859375f},
        {65519, 65504}, {1e9f, 65504},          {-1e9f, -65504},          {6e-8f, 5.9604644775390625e-8f},
        {2e-8f, 0},     {kInfinity, kInfinity}, {-kInfinity, -kInfinity}, {-0.5f, -0.5f}};
    Image image({0, 0, int(cases.size()), 1}, {"Y"});
    for (std::size_t i = 0; i < cases.size(); ++i) image.pixels[i] = cases[i].first;
    writeExr(dir.file("a.exr"), image);
    const Image read = readExr(dir.file("a.exr")).image;
    for (std::size_t i = 0; i < cases.size(); ++i)
        EXPECT_EQ(read.pixels[i], cases[i].second) << cases[i].first;

    image.pixels[0] = std::numeric_limits<float>::quiet_NaN();
    writeExr(dir.file("a.exr"), image);
    EXPECT_TRUE(std::isnan(readExr(dir.file("a.exr")).image.pixels[0]));
}

class HostileExr : public testing::Test {
protected:
    HostileExr() {
        writeExr(path_, wildImage({0, 0, 7, 40}, {"R", "G", "B"}), {{"comment", "x"}});
        good_ = readText(path_);
    }
    void expectRefused(const std::string& bytes, const std::string& part) {
        writeText(path_, bytes);
        expectError(ErrorCode::badInput, part, [&] { readExr(path_); });
    }
    /// The file with another data window.
    std::string withWindow(std::int32_t x0, std::int32_t y0, std::int32_t x1, std::int32_t y1) const {
        const std::string name("dataWindow\0box2i\0\x10\0\0\0", 21);
        const std::size_t place = good_.find(name);
        std::string bytes = good_;
        const std::int32_t box[] = {x0, y0, x1, y1};
        std::memcpy(bytes.data() + place + name.size(), box, sizeof box);
        return bytes;
    }

    TempDir dir_;
    const std::string path_ = dir_.file("a.exr");
    std::string good_;
};

TEST_F(HostileExr, truncatedAnywhereIsRefused) {
    for (std::size_t size = 0; size < good_.size(); size += 1 + size / 40)
        expectRefused(good_.substr(0, size), path_);
    expectRefused(good_.substr(0, good_.size() - 1), "damaged");
}

TEST_F(HostileExr, wrongKindsAreNamed) {
    expectRefused("", "is not an OpenEXR file");
    expectRefused(std::string(1000, '\0'), "is not an OpenEXR file");
    const auto flagged = [this](char flag) {
        std::string bytes = good_;
        bytes[5] = char(bytes[5] | flag);
        return bytes;
    };
    expectRefused(flagged(0x02), "tiled");
    expectRefused(flagged(0x08), "deep");
    expectRefused(flagged(0x10), "multi-part");
}

TEST_F(HostileExr, absurdSizesAreRefusedBeforeTheyAreAllocated) {
    expectRefused(withWindow(0, 0, 999999, 999999), path_);
    expectRefused(withWindow(0, 0, 0x7ffffffe, 0x7ffffffe), path_);
    expectRefused(withWindow(-0x7fffffff, -0x7fffffff, 0x7ffffffe, 0x7ffffffe), path_);
    expectRefused(withWindow(0, 0, 0x3ffffff0, 39), path_);
    expectRefused(withWindow(0, 0, 6, 0x3ffffff0), path_);
    expectRefused(withWindow(0, 0, 9999999, 39), "2^27");
    expectRefused(withWindow(0, 0, -1, -1), path_);
    expectRefused(withWindow(5, 5, 4, 4), path_);
}

TEST_F(HostileExr, flippedBytesNeverCrash) {
    std::mt19937 random(3);
    for (int i = 0; i < 300; ++i) {
        std::string bytes = good_;
        // The header is the interesting part; the size of an image stays what it was.
        const std::size_t place = random() % 400;
        bytes[place % bytes.size()] = char(random());
        writeText(path_, bytes);
        try {
            readExr(path_);
        } catch (const Error& error) {
            EXPECT_EQ(int(error.code()), int(ErrorCode::badInput)) << place << ": " << error.what();
        }
    }
}

TEST(Exr, pathsThatCannotBeUsed) {
    const TempDir dir;
    const Image image = Image::rgb(2, 2);
    expectError(ErrorCode::badInput, "no such file", [&] { readExr(dir.file("none.exr")); });
    expectError(ErrorCode::badInput, "not a regular file", [&] { readExr(dir.path().string()); });
    expectError(ErrorCode::badInput, "not a regular file", [&] { readExr("/dev/zero"); });
    expectError(ErrorCode::resources, "no/a.exr", [&] { writeExr(dir.file("no/a.exr"), image); });
    expectError(ErrorCode::resources, "/dev/full", [&] { writeExr("/dev/full", image); });
    expectError(ErrorCode::resources, "empty.exr",
                [&] { writeExr(dir.file("empty.exr"), Image::rgb(0, 0)); });
    EXPECT_EQ(dir.entries(), 0u);
}

} // namespace
} // namespace slant

// Pictures of all kinds have the texels that were written, and those that are damaged are refused.
#include "image/picture.h"

#include "base/error.h"
#include "image/png.h"
#include "scene/latlong.h"
#include "support/make_picture.h"
#include "support/temp_dir.h"

#include <cmath>
#include <glm/glm.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numbers>

namespace slant {
namespace {

using test::PictureKind;

struct Case {
    PictureKind kind;
    const char* name;
    bool encoded;
    float scale, bound;
};
// JPEG halves the resolution of colour: measured 0.03 on this ramp.
constexpr Case kCases[] = {{PictureKind::jpeg, "a.jpg", true, 1, 0.05f},
                           {PictureKind::tga, "a.tga", true, 1, 0.003f},
                           {PictureKind::hdr, "a.hdr", false, 1, 1 / 128.f},
                           {PictureKind::pfm, "a.pfm", false, 2, 0}};

class Pictures : public testing::Test {
protected:
    Picture read(const std::string& name, const std::string& bytes) const {
        test::writeText(dir.file(name), bytes);
        return readPicture(dir.file(name));
    }
    std::string errorOf(const std::string& name, const std::string& bytes) const {
        try {
            read(name, bytes);
        } catch (const Error& error) {
            return error.code() == ErrorCode::badInput ? error.message() : "not badInput";
        }
        return "";
    }

    test::TempDir dir;
};

TEST_F(Pictures, haveTheirTexels) {
    for (const Case& c : kCases) {
        const Picture picture = read(c.name, pictureBytes(c.kind));
        EXPECT_EQ(picture.encoded, c.encoded) << c.name;
        ASSERT_EQ(picture.image.width(), test::kPictureWidth) << c.name;
        ASSERT_EQ(picture.image.height(), test::kPictureHeight) << c.name;
        ASSERT_THAT(picture.image.channels, testing::ElementsAre("R", "G", "B")) << c.name;
        for (int y = 0; y < test::kPictureHeight; ++y)
            for (int x = 0; x < test::kPictureWidth; ++x)
                for (int i = 0; i < 3; ++i)
                    ASSERT_NEAR(picture.image.at(x, y, i),
                                c.scale * test::pictureColour(x, y)[std::size_t(i)], c.bound)
                        << c.name << " " << x << " " << y;
    }
}

TEST_F(Pictures, areKnownByTheirBytes) {
    EXPECT_EQ(read("a.png", pictureBytes(PictureKind::jpeg)).image.width(), test::kPictureWidth);
    writePng(dir.file("b.tga"), {1, 1, 1, {7}});
    EXPECT_EQ(readPicture(dir.file("b.tga")).image.width(), 1);
    EXPECT_THAT(errorOf("a.png", pictureBytes(PictureKind::tga)), testing::HasSubstr("of an unknown kind"));
}

TEST_F(Pictures, cutShortAreRefused) {
    for (const Case& c : kCases) {
        const std::string bytes = pictureBytes(c.kind);
        // The last bytes of a JPEG may hold nothing that is seen.
        for (std::size_t length = 0; length + 4 < bytes.size(); length += 7)
            EXPECT_NE(errorOf(c.name, bytes.substr(0, length)), "")
                << c.name << " " << length << " of " << bytes.size();
    }
}

TEST_F(Pictures, ofAbsurdSizeAreRefused) {
    EXPECT_THAT(errorOf("a.pfm", "PF\n1000000 1000000\n-1\n1234"), testing::HasSubstr("more than the limit"));
    EXPECT_THAT(errorOf("a.pfm", "PF\n-4 4\n-1\n1234"), testing::HasSubstr("or none"));
    std::string tga = pictureBytes(PictureKind::tga);
    for (const std::size_t at : {12u, 13u, 14u, 15u}) tga[at] = '\xff';
    EXPECT_THAT(errorOf("a.tga", tga), testing::HasSubstr("65535x65535 pixels are more than the limit"));
    std::string hdr = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 900000 +X 900000\n";
    EXPECT_NE(errorOf("a.hdr", hdr), "");
}

TEST_F(Pictures, bigEndianFloats) {
    const Picture picture = read("a.pfm", std::string("Pf\n1 1\n1\n\x3f\x80\x00\x00", 13));
    EXPECT_EQ(picture.image.at(0, 0, 0), 1);
}

/// What is white on one side of a latitude-longitude image shines from there, with as much power.
TEST(LatLong, keepsDirectionsAndPower) {
    constexpr int kHeight = 32;
    Image latLong = Image::rgb(2 * kHeight, kHeight);
    double power = 0;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < 2 * kHeight; ++x) {
            const double polar = (y + 0.5) / kHeight * std::numbers::pi;
            const double turn = (x + 0.5) / kHeight * std::numbers::pi;
            latLong.at(x, y, 0) = float(1 + std::cos(polar));                  // towards +z
            latLong.at(x, y, 1) = float(1 + std::sin(polar) * std::cos(turn)); // towards +x
            latLong.at(x, y, 2) = float(1 + std::sin(polar) * std::sin(turn)); // towards +y
            power +=
                double(latLong.at(x, y, 0)) * std::sin(polar) * std::numbers::pi / (4 * kHeight * kHeight);
        }
    EXPECT_NEAR(power, 1, 1e-3);
    const Image square = octahedralOfLatLong(latLong);
    ASSERT_EQ(square.width(), square.height());
    glm::dvec3 mean(0);
    for (int y = 0; y < square.height(); ++y)
        for (int x = 0; x < square.width(); ++x)
            for (int c = 0; c < 3; ++c)
                mean[c] += double(square.at(x, y, c)) / (square.width() * square.height());
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean[c], 1, 3e-3) << c; // equal areas: the mean is the power
    const int last = square.width() - 1, middle = square.width() / 2;
    EXPECT_GT(square.at(middle, middle, 0), 1.95f); // +z in the middle,
    EXPECT_LT(square.at(0, 0, 0), 0.05f);           // -z in the corners,
    EXPECT_GT(square.at(last, middle, 1), 1.9f);    // +x at the right, +y at the bottom
    EXPECT_GT(square.at(middle, last, 2), 1.9f);
}

} // namespace
} // namespace slant

#include "image/exr.h"
#include "image/png.h"
#include "support/run_program.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <nlohmann/json.hpp>
#include <regex>

namespace slant {
namespace {

using test::ProgramResult;
using test::runSlant;
using test::TempDir;
using testing::HasSubstr;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

class Diff : public testing::Test {
protected:
    Diff() {
        Image image = Image::rgb(5, 4);
        for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = 0.01f * float(i * i % 97);
        writeExr(reference_, image, {}, ExrPrecision::float32);
        image.at(3, 2, 1) += 0.5f;
        writeExr(other_, image, {}, ExrPrecision::float32);
        image.at(1, 0, 2) = kNaN;
        writeExr(broken_, image);
    }
    /// Runs diff of other_ and reference_ and expects the status, and one line on stderr if it is not 0.
    ProgramResult diff(std::vector<std::string> words, int status) {
        words.insert(words.begin(), "diff");
        const ProgramResult result = runSlant(words);
        EXPECT_EQ(result.status, status) << testing::PrintToString(words) << result.err;
        EXPECT_EQ(result.errorLines(), status == 0 ? 0 : 1) << result.err;
        return result;
    }

    TempDir dir_;
    const std::string reference_ = dir_.file("reference.exr"), other_ = dir_.file("other.exr"),
                      broken_ = dir_.file("broken.exr"), map_ = dir_.file("map.png");
};

TEST_F(Diff, tableNamesTheWorstPixel) {
    const ProgramResult result = diff({other_, reference_}, 0);
    EXPECT_THAT(result.out, HasSubstr("5x4, R G B"));
    EXPECT_THAT(result.out, HasSubstr("maximum error    0.5 at (3, 2) G: "));
    EXPECT_THAT(diff({reference_, reference_}, 0).out, HasSubstr("PSNR             inf dB"));
}

TEST_F(Diff, jsonHoldsEveryFigure) {
    const auto json = nlohmann::json::parse(diff({"--json", other_, reference_}, 0).out);
    EXPECT_NEAR(json["mse"].get<double>(), 0.25 / 60, 1e-7);
    EXPECT_NEAR(json["psnr"].get<double>(), 10 * std::log10(240), 1e-5);
    EXPECT_EQ(json["worst"]["x"], 3);
    EXPECT_EQ(json["worst"]["y"], 2);
    EXPECT_EQ(json["worst"]["channel"], "G");
    EXPECT_EQ(json["channelDrift"]["R"], 0.0);
    EXPECT_GT(json["drift"].get<double>(), 0);
    EXPECT_EQ(json["nonFinite"], 0);
    for (const char* key : {"relMse", "mae", "p99", "maxAbs", "flip"})
        EXPECT_TRUE(json[key].is_number()) << key;
}

TEST_F(Diff, eachBoundCanHoldAndFail) {
    const std::vector<std::array<std::string, 4>> bounds = {
        {"--max-mse", "0.005", "0.004", "MSE"},         {"--max-relmse", "100", "1e-4", "relMSE"},
        {"--min-psnr", "23.8", "23.9", "PSNR"},         {"--max-abs", "0.51", "0.49", "maximum error"},
        {"--max-drift", "0.5", "0.0001", "mean drift"}, {"--max-p99", "0.51", "0", "99th percentile"},
        {"--max-flip", "0.9", "0.001", "FLIP"}};
    for (const auto& [option, loose, tight, name] : bounds) {
        diff({option, loose, other_, reference_}, 0);
        const ProgramResult result = diff({option, tight, other_, reference_}, 1);
        EXPECT_THAT(result.err, HasSubstr(name));
        EXPECT_THAT(result.err, testing::ContainsRegex(" by [0-9]")) << option;
        EXPECT_THAT(result.out, HasSubstr("relMSE"));
        diff({option, loose, broken_, reference_}, 1);
    }
    EXPECT_THAT(diff({"--max-mse", "0", "--max-abs", "0", other_, reference_}, 1).err,
                HasSubstr("; maximum error"));
    diff({"--max-mse", "0", "--max-drift", "0", "--max-p99", "0", "--max-flip", "0", "--min-psnr", "999",
          other_, other_},
         0);
}

TEST_F(Diff, exposureIsThatOfTheFlipPictures) {
    const auto flipAt = [&](const char* stops) {
        const auto json =
            nlohmann::json::parse(diff({"--json", "--exposure", stops, other_, reference_}, 0).out);
        EXPECT_NEAR(json["mse"].get<double>(), 0.25 / 60, 1e-7);
        return json["flip"].get<double>();
    };
    EXPECT_LT(flipAt("-8"), flipAt("0"));
    EXPECT_THAT(diff({"--exposure", "-1.5", other_, reference_}, 0).out, HasSubstr(" at -1.5 stops"));
}

TEST_F(Diff, figuresAreOfColoursAndLayersApart) {
    Image image({0, 0, 5, 4}, {"R", "G", "B", "A", "Z", "N.X", "N.Y"}), plain = Image::rgb(5, 4);
    Image reference({0, 0, 5, 4}, {"R", "G", "B", "A", "Z", "albedo.R"});
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 5; ++x) {
            reference.at(x, y, 4) = 100;
            image.at(x, y, 4) = 103;
        }
    image.at(2, 1, 0) = 0.5f;
    image.at(3, 1, 6) = 7;
    const std::string a = dir_.file("a.exr"), b = dir_.file("b.exr"), c = dir_.file("c.exr");
    writeExr(a, image);
    writeExr(b, reference);
    writeExr(c, plain);
    const ProgramResult result = diff({a, b, "--max-mse", "0.0042"}, 0);
    EXPECT_THAT(result.out, HasSubstr("5x4, R G B\n"));
    EXPECT_THAT(result.out, HasSubstr("  MSE              0.00416667\n"));
    EXPECT_THAT(result.out,
                HasSubstr("  A                MSE 0, relMSE 0, maximum error 0, mean drift +0.000 %\n"));
    EXPECT_THAT(result.out, HasSubstr("  Z                MSE 9, relMSE 0.000899999, maximum error 3, "
                                      "mean drift +3.000 %\n"));
    EXPECT_THAT(result.out, HasSubstr("  not in both      N.X N.Y albedo.R\n"));
    EXPECT_THAT(diff({a, c}, 0).out, HasSubstr("  not in both      A Z N.X N.Y\n"));

    const auto json = nlohmann::json::parse(diff({"--json", a, a}, 0).out);
    EXPECT_EQ(json["layers"].size(), 3);
    EXPECT_EQ(json["layers"]["N"]["channels"], (std::vector<std::string>{"N.X", "N.Y"}));
    EXPECT_EQ(json["layers"]["N"]["maxAbs"], 0.0);
    EXPECT_TRUE(json["notInBoth"].empty());
    image.at(0, 0, 4) = kNaN;
    writeExr(a, image);
    EXPECT_THAT(diff({a, b}, 1).err, HasSubstr("1 values of Z are NaN or infinite"));
    EXPECT_THAT(diff({a, b}, 1).out, HasSubstr("  Z                1 non-finite\n"));
}

TEST_F(Diff, nonFiniteFailsWithoutAnyBound) {
    EXPECT_THAT(diff({broken_, reference_}, 1).out, HasSubstr("non-finite       1, first at (1, 0) B: nan"));
    diff({reference_, broken_}, 1);
    diff({broken_, broken_}, 1);
    const auto json = nlohmann::json::parse(diff({"--json", broken_, reference_}, 1).out);
    EXPECT_TRUE(json["mse"].is_null());
    EXPECT_TRUE(json["flip"].is_null());
    EXPECT_EQ(json["firstNonFinite"]["x"], 1);
}

TEST_F(Diff, heatMapIsWrittenOrRefusedEarly) {
    EXPECT_THAT(diff({other_, reference_, "--heat-map", map_}, 0).out, HasSubstr("map.png: 0 to "));
    const Image map = readPng(map_);
    EXPECT_EQ(map.width(), 5);
    EXPECT_FLOAT_EQ(map.at(3, 2, 1), 253 / 255.f);
    EXPECT_EQ(map.at(0, 0, 0), 0);
    diff({other_, reference_, "--heat-map", dir_.file("no/map.png")}, 5);
    diff({other_, reference_, "--heat-map", dir_.path().string()}, 5);
    EXPECT_EQ(diff({other_, reference_, "--heat-map", "/dev/full"}, 5).out, "");
}

TEST_F(Diff, pngsAreDecoded) {
    const std::string a = dir_.file("a.png"), b = dir_.file("b.png");
    writePng(a, {1, 1, 3, {188, 188, 188}}); // 0.5029 linear
    writePng(b, {1, 1, 3, {0, 0, 0}});
    const auto json = nlohmann::json::parse(diff({"--json", a, b}, 0).out);
    EXPECT_NEAR(json["maxAbs"].get<double>(), 0.502886, 1e-5);
    diff({"--max-mse", "0", a, a}, 0);
}

TEST_F(Diff, unreadableFilesGiveStatusThree) {
    const std::string text = dir_.file("text.exr"), png = dir_.file("fake.png"),
                      small = dir_.file("small.exr");
    test::writeText(text, "no picture\n");
    test::writeText(png, "no picture\n");
    writeExr(small, Image::rgb(2, 2));
    for (const std::string& bad : {text, png, dir_.file("none.exr"), dir_.file("none.png"),
                                   dir_.path().string(), std::string("/dev/zero"), small}) {
        EXPECT_THAT(diff({bad, reference_}, 3).err, HasSubstr(bad));
        EXPECT_THAT(diff({reference_, bad}, 3).err, HasSubstr(bad));
    }
}

TEST_F(Diff, wrongOptionsGiveStatusTwo) {
    const std::vector<std::vector<std::string>> wrong = {
        {},
        {reference_},
        {reference_, other_, other_},
        {reference_, other_, "--max-mse"},
        {reference_, other_, "--max-mse", "abc"},
        {reference_, other_, "--max-mse", "-1"},
        {reference_, other_, "--max-abs", "nan"},
        {reference_, other_, "--max-drift", "1e999"},
        {reference_, other_, "--min-psnr", ""},
        {reference_, other_, "--max-mse", "1", "--max-mse", "2"},
        {reference_, other_, "--json=maybe"},
        {reference_, other_, "--max-flip", "1.5"},
        {reference_, other_, "--exposure", "99"},
        {reference_, other_, "--heat-map"},
    };
    for (const auto& words : wrong) EXPECT_EQ(diff(words, 2).out, "");
    EXPECT_THAT(diff({reference_, other_, "--max-msr", "1"}, 2).err, HasSubstr("did you mean '--max-mse'?"));
    EXPECT_THAT(runSlant({"dif"}).err, HasSubstr("did you mean 'diff'?"));
}

TEST_F(Diff, agreesWithIdiff) {
    if (test::runWords({"idiff", "--help"}).status != 0)
        GTEST_SKIP() << "idiff of openimageio-tools is missing";
    const std::string out = test::runWords({"idiff", "-a", reference_, other_}).out;
    const auto json = nlohmann::json::parse(diff({"--json", other_, reference_}, 0).out);
    const auto figure = [&](const std::string& label) {
        std::smatch match;
        EXPECT_TRUE(std::regex_search(out, match, std::regex(label + "\\s*=\\s*([0-9.e+-]+)"))) << out;
        return match.empty() ? -1.0 : std::stod(match[1]);
    };
    EXPECT_NEAR(figure("Mean error"), json["mae"].get<double>(), 1e-6);
    EXPECT_NEAR(figure("RMS error"), std::sqrt(json["mse"].get<double>()), 1e-6);
    EXPECT_NEAR(figure("Max error"), json["maxAbs"].get<double>(), 1e-6);
    EXPECT_NEAR(figure("Peak SNR"), json["psnr"].get<double>(), 1e-3);
    EXPECT_THAT(out, HasSubstr("@ (3, 2, G)"));
}

} // namespace
} // namespace slant

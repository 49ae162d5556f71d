#include "base/error.h"
#include "base/suggest.h"
#include "commands/options.h"
#include "commands/stats_file.h"
#include "commands/terminal_monitor.h"
#include "support/temp_dir.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <regex>
#include <thread>

namespace slant::commands {
namespace {

using test::readText;
using test::TempDir;

/// What a monitor prints while `run` uses it.
template <typename Run>
std::string printed(TerminalMonitor::Style style, const Run& run) {
    const TempDir dir;
    const std::string path = dir.file("log");
    std::FILE* stream = std::fopen(path.c_str(), "w");
    {
        TerminalMonitor monitor(style, stream);
        run(monitor);
    }
    std::fclose(stream);
    return readText(path);
}

/// Percentages in the order in which they were printed.
std::vector<int> percentages(const std::string& text) {
    static const std::regex pattern("(\\d+) %");
    std::vector<int> result;
    for (std::sregex_iterator i(text.begin(), text.end(), pattern), end; i != end; ++i)
        result.push_back(std::stoi((*i)[1]));
    return result;
}

TEST(TerminalMonitor, barIsMonotoneFiniteAndEndsAtHundred) {
    const std::string text = printed(TerminalMonitor::Style::bar, [](TerminalMonitor& monitor) {
        monitor.beginStage("trace", 1000, "samples");
        const auto work = [&] {
            for (int i = 0; i < 25; ++i) {
                monitor.advance(20);
                std::this_thread::sleep_for(std::chrono::milliseconds(13));
            }
        };
        std::thread other(work);
        work();
        other.join();
        monitor.endStage();
    });
    const std::vector<int> seen = percentages(text);
    ASSERT_GE(seen.size(), 3u) << text;
    EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end())) << text;
    EXPECT_EQ(seen.back(), 100);
    EXPECT_THAT(text, testing::Not(testing::ContainsRegex("nan|inf")));
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1);
}

TEST(TerminalMonitor, survivesOddStages) {
    const std::string text = printed(TerminalMonitor::Style::bar, [](TerminalMonitor& monitor) {
        monitor.advance(1); // no stage
        monitor.beginStage("none", 0, "pixels");
        monitor.beginStage("short", 10, "pixels"); // ends the one before
        monitor.advance(1000);                     // more than announced
        monitor.endStage();
        monitor.endStage();
        ASSERT_EQ(monitor.stages().size(), 2u);
        EXPECT_EQ(monitor.stages()[0].name, "none");
        EXPECT_EQ(monitor.stages()[1].items, 1000u);
        EXPECT_EQ(monitor.stages()[1].unit, "pixels");
        EXPECT_GT(monitor.stages()[1].seconds, 0);
    });
    EXPECT_THAT(percentages(text), testing::Each(100));
}

TEST(TerminalMonitor, quietStillWarnsAndCounts) {
    const std::string text = printed(TerminalMonitor::Style::quiet, [](TerminalMonitor& monitor) {
        monitor.beginStage("trace", 10, "samples");
        monitor.warn("two\nlines \x1b[2J");
        monitor.endStage();
        EXPECT_EQ(monitor.stages().size(), 1u);
    });
    EXPECT_EQ(text, "slant: warning: two lines  [2J\n");
}

TEST(TerminalMonitor, linesAreWholeLines) {
    const std::string text = printed(TerminalMonitor::Style::lines, [](TerminalMonitor& monitor) {
        monitor.beginStage("trace", 10, "samples");
        monitor.advance(5);
        monitor.endStage();
    });
    EXPECT_THAT(text, testing::MatchesRegex("slant: trace 100 %, [^\n]* samples/s, [^\n]* s\n"));
}

TEST(Options, numbersAreWholeAndFinite) {
    EXPECT_EQ(parseNumber<int>("-12"), -12);
    EXPECT_EQ(parseNumber<std::uint64_t>("18446744073709551615"), ~std::uint64_t(0));
    EXPECT_EQ(parseNumber<double>("1e-3"), 1e-3);
    for (const char* bad : {"", " 1", "1 ", "1e9", "0x10", "abc", "4.5", "99999999999999"})
        EXPECT_FALSE(parseNumber<int>(bad)) << bad;
    EXPECT_FALSE(parseNumber<std::uint64_t>("-3"));
    for (const char* bad : {"nan", "inf", "-inf", "1e999", ""}) EXPECT_FALSE(parseNumber<double>(bad)) << bad;
}

TEST(Options, sizes) {
    EXPECT_EQ(parseSize("4096"), 4096u);
    EXPECT_EQ(parseSize("512M"), 512u << 20);
    EXPECT_EQ(parseSize("2G"), std::uint64_t(2) << 30);
    EXPECT_EQ(parseSize("16777215T"), std::uint64_t(16777215) << 40);
    for (const char* bad : {"", "G", "2GB", "-2G", "1.5G", "16777216T", "G2"})
        EXPECT_FALSE(parseSize(bad)) << bad;
}

TEST(Options, crops) {
    EXPECT_EQ(parseCrop("1,20,-3,40"), (Rect{1, -3, 20, 40}));
    for (const char* bad :
         {"", "1,2,3", "1,2,3,4,5", "2,2,0,1", "3,2,0,1", "0,1,0,x", "0,1,0,", "0,2000000,0,1"})
        EXPECT_FALSE(parseCrop(bad)) << bad;
}

TEST(Options, fillOneStruct) {
    CLI::App app;
    CommonOptions options;
    addSamplingOptions(app, options);
    addReconstructionOptions(app, options);
    addRunOptions(app, options);
    app.parse(
        "--spp 8 --seed 7 --crop 0,10,0,20 --out-spp 64 --method box --device cpu --memory 64M --threads 2 "
        "--quiet --stats s.json --window-range 7 --window-alpha 2.5 --window-delta 0.25 --window-fill");
    EXPECT_EQ(options.spp, 8);
    EXPECT_EQ(options.seed, 7u);
    EXPECT_EQ(options.crop, (Rect{0, 0, 10, 20}));
    EXPECT_EQ(options.outSpp, 64);
    EXPECT_EQ(options.method, Method::box);
    EXPECT_EQ(options.device, "cpu");
    EXPECT_EQ(options.memoryBytes, 64u << 20);
    EXPECT_EQ(options.window.rangePx, 7);
    EXPECT_EQ(options.window.alpha, 2.5f);
    EXPECT_EQ(options.window.lensStep, 0.25f);
    EXPECT_TRUE(options.window.fill);
    EXPECT_THROW(checkMethodOptions(options), Error); // they are not of box
    options.method = Method::window;
    EXPECT_NO_THROW(checkMethodOptions(options));
    EXPECT_EQ(options.threads, 2);
    EXPECT_TRUE(options.quiet);
    EXPECT_EQ(options.statsPath, "s.json");
}

TEST(Options, refuseWhatIsOutOfRange) {
    for (const char* bad : {"--spp 0", "--spp -3", "--spp 1e9", "--spp abc", "--spp 65537", "--spp 010x",
                            "--seed -1", "--crop 1,2,3", "--out-spp 0", "--method ful", "--memory 1M",
                            "--memory 2X", "--threads -1", "--threads 2000", "--spp"}) {
        CLI::App app;
        CommonOptions options;
        addSamplingOptions(app, options);
        addReconstructionOptions(app, options);
        addRunOptions(app, options);
        EXPECT_THROW(app.parse(bad), CLI::ParseError) << bad;
    }
}

TEST(Suggest, nearestNameOrNone) {
    const std::vector<std::string_view> names = {"render", "reference", "diff", "devices"};
    EXPECT_EQ(closestName("rendr", names), "render");
    EXPECT_EQ(closestName("REFERENCE", names), "reference");
    EXPECT_EQ(closestName("idff", names), "diff");
    EXPECT_EQ(closestName("banana", names), "");
    EXPECT_EQ(closestName("", names), "");
    EXPECT_EQ(closestName(std::string(100000, 'x'), names), "");
    EXPECT_EQ(didYouMean("dif", names), ", did you mean 'diff'?");
    EXPECT_EQ(didYouMean("zzz", names), "");
}

TEST(StatsFile, holdsEveryFieldAndStaysFinite) {
    const std::vector<StageStats> stages = {{"trace", 2.0, 0.5, 1000, "samples", 4096},
                                            {"film", 0, 0, 7, "pixels", 0}};
    const auto json = statsJson(stages, 3.5, {{"scene", "row"}});
    EXPECT_EQ(json["scene"], "row");
    EXPECT_EQ(json["seconds"], 3.5);
    EXPECT_EQ(json["stages"][0], (nlohmann::ordered_json{{"name", "trace"},
                                                         {"seconds", 2.0},
                                                         {"deviceSeconds", 0.5},
                                                         {"items", 1000},
                                                         {"unit", "samples"},
                                                         {"bytes", 4096},
                                                         {"itemsPerSecond", 500.0}}));
    EXPECT_TRUE(json["stages"][1]["itemsPerSecond"].is_null());

    const TempDir dir;
    writeStats(dir.file("s.json"), stages, 3.5, {{"device", "bytes \xff that are no UTF-8"}});
    EXPECT_EQ(nlohmann::json::parse(readText(dir.file("s.json")))["stages"].size(), 2u);
    EXPECT_THROW(writeStats(dir.file("no/s.json"), stages, 3.5, {}), Error);
}

} // namespace
} // namespace slant::commands

// Files of results, charts and the page, from points made up here.
#include "base/hash.h"
#include "report/chart.h"
#include "report/gnuplot.h"
#include "report/page.h"
#include "report/results.h"
#include "report/timing.h"
#include "report/work_monitor.h"
#include "support/expect_error.h"
#include "support/temp_dir.h"

#include <cmath>
#include <filesystem>

namespace slant {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

Point point(const std::string& method, int spp, double seconds, double relMse) {
    Point p;
    p.key = fmt::format("{}{}", method, spp);
    p.scene = "it's <A>";
    p.method = method;
    p.device = method == kReference ? "cpu" : "tool, \"fast\" (v1)";
    p.spp = spp;
    p.outputs = method == "full" ? 64 : 0;
    p.runs = 3;
    p.traceSeconds = seconds / 4;
    p.reconstructSeconds = seconds * 3 / 4;
    p.mse = relMse / 2;
    p.relMse = relMse;
    p.flip = std::sqrt(relMse);
    p.drift = -0.001;
    return p;
}

Results sample() {
    Results results;
    results.circumstances = {"today", "slant <chart>", "slant", "a machine", "settings"};
    results.scenes.push_back({"it's <A>", "folder/it's <A>.pbrt", 48, 27, 1024, "truth.png"});
    results.points = {point("full", 2, 1, 2e-3),       point("full", 8, 2, 5e-4),
                      point("box", 8, 0.5, 1e-1),      point(kReference, 4, 1, 1e-1),
                      point(kReference, 64, 16, 6e-3), point(kReference, 256, 64, 1e-3)};
    return results;
}

TEST(Hash, isFnv1a) {
    const auto digest = [](std::string_view bytes) {
        Hash hash;
        hash.addBytes(bytes);
        return hash.hex();
    };
    EXPECT_EQ(digest(""), "cbf29ce484222325");
    EXPECT_EQ(digest("a"), "af63dc4c8601ec8c");
    EXPECT_EQ(digest("foobar"), "85944171f73967e8");
    Hash split, joined;
    split.add("ab"), split.add("c");
    joined.add("a"), joined.add("bc");
    EXPECT_NE(split.hex(), joined.hex());
}

TEST(Results, pointsSurviveTheirFile) {
    Results results = sample();
    results.points[1].relMse = NAN;
    const auto json = nlohmann::ordered_json::parse(toJson(results).dump());
    EXPECT_TRUE(json["points"][1]["relMse"].is_null());
    const std::vector<Point> points = pointsFromJson(json);
    ASSERT_EQ(points.size(), results.points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Point &a = points[i], &b = results.points[i];
        EXPECT_EQ(std::tie(a.key, a.scene, a.method, a.device, a.spp, a.outputs, a.runs, a.traceSeconds,
                           a.reconstructSeconds, a.mse, a.flip, a.drift, a.picture, a.map),
                  std::tie(b.key, b.scene, b.method, b.device, b.spp, b.outputs, b.runs, b.traceSeconds,
                           b.reconstructSeconds, b.mse, b.flip, b.drift, b.picture, b.map));
    }
    EXPECT_TRUE(std::isnan(points[1].relMse));
    for (const char* wrong : {"{}", "[]", "3", R"({"points": [{"key": 3}]})", R"({"points": {}, "x": 1)"})
        EXPECT_THROW(pointsFromJson(nlohmann::ordered_json::parse(wrong)), nlohmann::json::exception)
            << wrong;
}

TEST(Results, gainsJoinASettingsOfAMethod) {
    const std::vector<MethodGain> gains = gainsOf(sample().points);
    ASSERT_EQ(gains.size(), 4u);
    EXPECT_EQ(gains[0].method, "full");
    EXPECT_EQ(gains[0].error, 1e-3);
    // From 2e-3 at 1 s to 5e-4 at 2 s: 1e-3 after sqrt(2) s; the reference needs 64 s.
    EXPECT_NEAR(gains[0].gain.equalError->value, 64 / std::sqrt(2), 1e-9);
    EXPECT_FALSE(gains[0].gain.equalError->atLeast);
    EXPECT_FALSE(gains[2].gain.equalError) << "box never gets there";
    const auto json = toJson(sample());
    EXPECT_NEAR(json["scenes"][0]["gainsOverReference"][0]["equalError"]["factor"].get<double>(), 45.25,
                0.01);
    EXPECT_TRUE(json["scenes"][0]["gainsOverReference"][3]["equalTime"].is_null());
}

TEST(Results, noiseOfTheTruthFollowsFromTheReference) {
    // e (1/256 + 1/1024) = 1e-3, so e/1024 = 2e-4.
    EXPECT_NEAR(truthNoise(sample().points, 1024), 2e-4, 1e-12);
    EXPECT_EQ(truthNoise({}, 1024), 0);
}

TEST(Results, csvHasARowAPoint) {
    const std::string csv = toCsv(sample().points);
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 7);
    EXPECT_THAT(csv,
                HasSubstr("\nit's <A>,full,2,64,\"tool, \"\"fast\"\" (v1)\",1,0.25,0.75,3,0.001,0.002,"));
}

TEST(Timing, mediansAndWarmUp) {
    EXPECT_EQ(medianOf({3}), 3);
    EXPECT_EQ(medianOf({9, 1, 5}), 5);
    EXPECT_EQ(medianOf({1, 9, 5, 3}), 4);
    int calls = 0;
    EXPECT_EQ(timeRuns(3, [&] { ++calls; }).runs, 3);
    EXPECT_EQ(calls, 4);
}

TEST(WorkMonitor, sharesAddUpWhateverIsReported) {
    struct Whole final : Monitor {
        void beginStage(std::string_view, std::uint64_t, std::string_view) override { ++stages; }
        void advance(std::uint64_t items) override { done += items; }
        void endStage() override { ++stages; }
        void warn(std::string_view message) override { warnings.emplace_back(message); }
        std::uint64_t done = 0, stages = 0;
        std::vector<std::string> warnings;
    } whole;
    WorkMonitor work(whole);
    work.beginShare(10, "a: ");
    work.beginStage("trace", 99, "samples");
    work.advance(4);
    work.advance(100); // more than announced
    EXPECT_EQ(whole.done, 10u);
    work.endStage();
    work.beginShare(5, "b: ");
    work.warn("odd");
    work.warn("odd");
    work.advance(1);
    work.endShare(); // less than announced
    EXPECT_EQ(whole.done, 15u);
    EXPECT_EQ(whole.stages, 0u);
    EXPECT_THAT(whole.warnings, ElementsAre("b: odd"));
}

TEST(Chart, drawsEveryCurveAndTheGains) {
    const Results results = sample();
    const std::string svg = runGnuplot(chartScript(results.scenes[0], results.points, Figure::relMse));
    EXPECT_THAT(svg, testing::StartsWith("<?xml"));
    EXPECT_THAT(svg, testing::EndsWith("</svg>\n\n"));
    for (const char* text :
         {"it's &lt;A>, 48x27, against 1024 samples per pixel", "full, 64 outputs", "reference",
          "Pareto front", "relMSE", "full, relMSE 0.001: speed 45\u00d7, accuracy 70\u00d7"})
        EXPECT_TRUE(svg.find(text) != std::string::npos) << text;
    const std::string flip = runGnuplot(chartScript(results.scenes[0], results.points, Figure::flip));
    EXPECT_THAT(flip, HasSubstr("FLIP"));
    EXPECT_THAT(flip, Not(HasSubstr("Speed")));
}

TEST(Chart, survivesOddPoints) {
    SceneSummary scene{"a_b^c{d}@e \\ \n '%s' $x`date`", "p", 1, 1, 64, ""};
    Point broken = point("box", 1, 1, NAN), perfect = point("full", 1, 1, 0);
    for (const std::vector<Point>& points :
         {std::vector<Point>{},
          {broken},
          {perfect},
          {point("box", 1, 1, 1)},
          {point("full", 1, 1e-6, 1e-12), point("full", 2, 1e5, 1e9), broken}}) {
        const std::string svg = runGnuplot(chartScript(scene, points, Figure::relMse));
        EXPECT_THAT(svg, HasSubstr("a_b^c{d}@e"));
        EXPECT_THAT(svg, HasSubstr("`date`"));
    }
}

TEST(Gnuplot, saysWhatIsWrong) {
    test::expectError(ErrorCode::resources, "gnuplot failed", [] { runGnuplot("nonsense\n"); });
    EXPECT_EQ(runGnuplot("print 1+2; set print '-'; print 1+2\n"), "3\n");
}

TEST(Page, isSelfContainedAndEscaped) {
    const test::TempDir dir;
    Results results = sample();
    results.points[1].picture = "p.png";
    results.points[1].map = "m.png";
    results.points[4].picture = results.points[4].map = "r.png";
    test::writeText(dir.file("truth.png"), "truth");
    test::writeText(dir.file("p.png"), "picture");
    test::writeText(dir.file("m.png"), "a map!");
    test::writeText(dir.file("r.png"), "\xff\xfe");
    const std::vector<SceneCharts> charts = {
        {"<?xml?>\n<svg id='one'></svg>", "<?xml?>\n<svg id='two'></svg>"}};
    const std::string page = pageOf(results, charts, dir.path().string());
    for (const char* text :
         {"base64,dHJ1dGg=\"", "base64,cGljdHVyZQ==\"", "base64,YSBtYXAh\"", "<h2>it's &lt;A&gt;</h2>",
          "<code>slant &lt;chart&gt;</code>", "<svg id='one'>", "<svg id='two'>", "width=device-width",
          "prefers-color-scheme: dark", "2 \u2192 64", "45\u00d7"})
        EXPECT_TRUE(page.find(text) != std::string::npos) << text;
    EXPECT_THAT(page, Not(HasSubstr("<A>")));
    EXPECT_THAT(page, Not(HasSubstr("<?xml")));
    EXPECT_THAT(page, Not(testing::ContainsRegex("(src|href)=\"[^d#]"))) << "something is not embedded";
    std::filesystem::remove(dir.file("m.png"));
    test::expectError(ErrorCode::badInput, "m.png", [&] { pageOf(results, charts, dir.path().string()); });
}

} // namespace
} // namespace slant

// Sweeps over a scene of a few pixels, on the CPU.
#include "report/sweep.h"
#include "report/truth.h"
#include "scene/read_scene.h"
#include "support/expect_error.h"
#include "support/scene_text.h"
#include "support/temp_dir.h"

#include <filesystem>

namespace slant {
namespace {

namespace fs = std::filesystem;

using testing::ElementsAre;

class SweepTest : public testing::Test {
protected:
    SweepTest() {
        writeScene("0.5");
        test::writeText(dir_.file("ball.txt"), "Shape \"sphere\" \"float radius\" 1\n");
        fs::create_directory(dir_.path() / "images");
        options_.scenes = {scene_};
        options_.methods = {Method::box, Method::full};
        options_.samples = {1, 2};
        options_.outputs = {4, 8};
        options_.devices = {"cpu"};
        options_.repeat = 1;
        options_.truthSpp = 64;
        options_.cacheDirectory = dir_.file("cache");
        options_.pictureDirectory = dir_.path().string();
    }

    void writeScene(const std::string& reflectance) const {
        test::writeText(scene_, "Film \"rgb\" \"integer xresolution\" 13 \"integer yresolution\" 9\n"
                                "Translate 0 0 4 Camera \"perspective\" \"float fov\" 40\n"
                                "\"float lensradius\" 0.2 \"float focaldistance\" 3\n"
                                "WorldBegin LightSource \"distant\"\n"
                                "Material \"diffuse\" \"rgb reflectance\" [" +
                                    reflectance + " 0.5 0.5]\nInclude \"ball.txt\"\n");
    }
    Results run(const std::vector<Point>& known = {}) {
        measured_ = 0;
        return runSweep(
            options_, known, [&](const Results&) { ++measured_; }, monitor_);
    }
    std::string keyOf() const {
        SilentMonitor monitor;
        const Scene scene = readScene(scene_, monitor);
        return contentKey(scene, Tracer(scene, monitor));
    }
    std::vector<fs::path> cached() const {
        return {fs::directory_iterator(options_.cacheDirectory), fs::directory_iterator()};
    }

    test::TempDir dir_;
    const std::string scene_ = dir_.file("tiny.pbrt");
    SweepOptions options_;
    test::RecordingMonitor monitor_;
    int measured_ = 0;
};

TEST_F(SweepTest, measuresEverySettingInOrder) {
    const Results results = run();
    std::vector<std::string> names;
    for (const Point& p : results.points)
        names.push_back(fmt::format("{} {} {}", p.method, p.spp, p.outputs));
    EXPECT_THAT(names, ElementsAre("box 1 0", "box 2 0", "full 1 4", "full 2 4", "full 1 8", "full 2 8",
                                   "reference 4 0", "reference 16 0"));
    EXPECT_EQ(measured_, 8);
    for (const Point& p : results.points) {
        EXPECT_GT(p.traceSeconds, 0);
        EXPECT_GE(p.reconstructSeconds, 0);
        EXPECT_EQ(p.runs, 1);
        EXPECT_GT(p.relMse, 0) << "the truth has other samples";
        EXPECT_GT(p.flip, 0);
        EXPECT_EQ(p.picture.empty(), !p.isReference() && !(p.spp == 2 && p.outputs != 4));
        for (const std::string& file : {p.picture, p.map})
            EXPECT_TRUE(file.empty() || fs::exists(dir_.path() / file)) << file;
    }
    EXPECT_LT(results.points[7].relMse, results.points[6].relMse);
    ASSERT_EQ(results.scenes.size(), 1u);
    EXPECT_EQ(results.scenes[0].name, "tiny");
    EXPECT_EQ(results.scenes[0].width, 13);
    EXPECT_TRUE(fs::exists(dir_.path() / results.scenes[0].truthPicture));
    EXPECT_THAT(monitor_.warnings, ElementsAre());
}

TEST_F(SweepTest, takesOverWhatIsKnown) {
    const Results first = run();
    EXPECT_EQ(run(first.points).points.size(), 8u);
    EXPECT_EQ(measured_, 0);
    // A part of the points, as after an interruption; one picture is lost.
    std::vector<Point> part = first.points;
    part.erase(part.begin() + 2, part.begin() + 4);
    fs::remove(dir_.path() / part.back().map);
    const Results second = run(part);
    EXPECT_EQ(measured_, 3);
    for (std::size_t i = 0; i < 8; ++i) {
        EXPECT_EQ(second.points[i].key, first.points[i].key);
        EXPECT_EQ(second.points[i].relMse, first.points[i].relMse) << "same seed, same picture";
    }
    EXPECT_EQ(second.points[0].traceSeconds, first.points[0].traceSeconds);
}

TEST_F(SweepTest, otherCircumstancesAreOtherPoints) {
    const Results first = run();
    const auto changed = [&](const auto& change) {
        const SweepOptions before = options_;
        change();
        run(first.points);
        options_ = before;
        return measured_;
    };
    EXPECT_EQ(changed([&] { options_.seed = 1; }), 8);
    EXPECT_EQ(changed([&] { options_.repeat = 2; }), 8);
    EXPECT_EQ(changed([&] { options_.truthSpp = 65; }), 8);
    EXPECT_EQ(changed([&] { options_.exposure = 1; }), 8);
    EXPECT_EQ(changed([&] { options_.halfSize = true; }), 8);
    EXPECT_EQ(changed([&] { options_.outputs = {4, 8, 16}; }), 2);
    EXPECT_EQ(changed([&] {
                  options_.scenes = {dir_.file("twin.pbrt")};
                  fs::copy_file(scene_, options_.scenes[0]);
              }),
              8);
    EXPECT_EQ(changed([&] { writeScene("0.6"); }), 8);
}

TEST_F(SweepTest, halfSizeIsHalfTheResolution) {
    options_.halfSize = true;
    const Results results = run();
    EXPECT_EQ(results.scenes[0].width, 7);
    EXPECT_EQ(results.scenes[0].height, 5);
}

TEST_F(SweepTest, truthIsKeptAndMadeAgainWhenDamaged) {
    run();
    ASSERT_EQ(cached().size(), 1u);
    const fs::path file = cached()[0];
    const std::string bytes = test::readText(file.string());
    const auto written = fs::last_write_time(file);
    const Results second = run();
    EXPECT_EQ(fs::last_write_time(file), written);
    test::writeText(file.string(), bytes.substr(0, bytes.size() / 2));
    EXPECT_EQ(run().points[0].mse, second.points[0].mse);
    EXPECT_EQ(test::readText(file.string()), bytes);
    EXPECT_THAT(monitor_.warnings, ElementsAre(testing::HasSubstr("it is made again")));
    options_.seed = 5; // other samples under test, so another truth
    run();
    EXPECT_EQ(cached().size(), 2u);
}

TEST_F(SweepTest, contentKeyFollowsEveryFile) {
    const std::string key = keyOf();
    EXPECT_EQ(keyOf(), key);
    writeScene("0.51");
    EXPECT_NE(keyOf(), key);
    writeScene("0.5");
    EXPECT_EQ(keyOf(), key);
    test::writeText(dir_.file("ball.txt"), "Shape \"sphere\" \"float radius\" 1 # named alike\n");
    EXPECT_NE(keyOf(), key);
}

TEST_F(SweepTest, refusesWhatCannotBeToldApart) {
    fs::create_directory(dir_.path() / "other");
    fs::copy_file(scene_, dir_.path() / "other" / "tiny.pbrt");
    options_.scenes.push_back(dir_.file("other/tiny.pbrt"));
    test::writeText(dir_.file("other/ball.txt"), "");
    test::expectError(ErrorCode::usage, "two scenes are called 'tiny'", [&] { run(); });
    options_.scenes.pop_back();
    options_.devices = {"cpu", "cpu"};
    test::expectError(ErrorCode::usage, "two devices are 'cpu'", [&] { run(); });
}

TEST_F(SweepTest, referenceRisesToAQuarterOfTheTruth) {
    EXPECT_THAT(referenceSamples(64), ElementsAre(4, 16));
    EXPECT_THAT(referenceSamples(4096), ElementsAre(4, 16, 64, 256, 1024));
}

} // namespace
} // namespace slant

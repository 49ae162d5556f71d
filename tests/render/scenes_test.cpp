// The scenes that come with Slant: what the generator makes, small, and read without a warning.
#include "base/monitor.h"
#include "scene/read_scene.h"
#include "support/run_program.h"

#include <filesystem>
#include <gtest/gtest.h>
#include <set>

namespace slant {
namespace {

namespace fs = std::filesystem;

const fs::path kScenes = fs::path(SLANT_SOURCE_DIR) / "scenes";
constexpr std::uintmax_t kMaxSceneBytes = 2'000'000;

class StrictMonitor final : public Monitor {
public:
    void beginStage(std::string_view, std::uint64_t, std::string_view) override {}
    void advance(std::uint64_t) override {}
    void endStage() override {}
    void warn(std::string_view message) override { ADD_FAILURE() << message; }
};

Scene load(const std::string& name) {
    StrictMonitor monitor;
    return readScene((kScenes / (name + ".pbrt")).string(), monitor);
}

TEST(Scenes, theGeneratorMakesTheCommittedBytes) {
    const test::TempDir dir;
    const auto run = test::runWords({"python3", (kScenes / "generate.py").string(), dir.path().string()});
    ASSERT_EQ(run.status, 0) << run.err;
    std::size_t files = 0;
    for (const auto& entry : fs::recursive_directory_iterator(dir.path())) {
        if (!entry.is_regular_file()) continue;
        const fs::path committed = kScenes / fs::relative(entry.path(), dir.path());
        ASSERT_TRUE(fs::exists(committed)) << committed;
        EXPECT_TRUE(test::readText(entry.path().string()) == test::readText(committed.string())) << committed;
        ++files;
    }
    EXPECT_GE(files, 10u);
}

TEST(Scenes, areSmallAndReadWithoutAWarning) {
    for (const std::string name : {"spheres", "row", "lights", "foliage", "indirect", "row-dgauss",
                                   "row-wide", "row-telephoto", "row-fisheye"}) {
        const Scene scene = load(name);
        EXPECT_EQ(scene.film.xResolution, 480) << name;
        EXPECT_EQ(scene.film.yResolution, 270) << name;
        EXPECT_EQ(scene.pixelSamples, 8) << name;
        EXPECT_TRUE(scene.camera.lensRadius > 0 || scene.realistic) << name;
        std::uintmax_t bytes = 0;
        for (const std::string& file : std::set(scene.files.begin(), scene.files.end()))
            bytes += fs::file_size(file);
        EXPECT_LT(bytes, kMaxSceneBytes) << name;
    }
}

TEST(Scenes, spheresIsShadedWithoutNoise) {
    const Scene scene = load("spheres");
    ASSERT_EQ(scene.lights.size(), 1u);
    EXPECT_EQ(scene.lights[0].kind, LightKind::distant);
    EXPECT_TRUE(scene.areaLights.empty());
    EXPECT_EQ(scene.maxDepth, 1);
    EXPECT_EQ(scene.filter.kind, FilterKind::box);
    int balls = 0;
    for (const Shape& shape : scene.shapes) balls += shape.kind == ShapeKind::sphere;
    EXPECT_EQ(balls, 100);
}

} // namespace
} // namespace slant

// The scenes that come with Slant: what the generator makes, small, and read without a warning.
#include "base/monitor.h"
#include "scene/read_scene.h"
#include "support/run_program.h"

#include <algorithm>
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
    for (const std::string name : {"spheres", "row", "lights", "foliage", "indirect", "mirror", "still-life",
                                   "row-dgauss", "row-wide", "row-telephoto", "row-fisheye", "spin",
                                   "crossing", "dolly", "butterflies", "shadows", "shadows-defocused"}) {
        const Scene scene = load(name);
        EXPECT_EQ(scene.film.xResolution, 480) << name;
        EXPECT_EQ(scene.film.yResolution, 270) << name;
        EXPECT_EQ(scene.pixelSamples, 8) << name;
        EXPECT_EQ(scene.camera.lensRadius > 0 || scene.realistic, name != "shadows") << name;
        std::uintmax_t bytes = 0;
        for (const std::string& file : std::set(scene.files.begin(), scene.files.end()))
            bytes += fs::file_size(file);
        EXPECT_LT(bytes, kMaxSceneBytes) << name;
    }
}

TEST(Scenes, spheresAndThoseThatMoveAreShadedWithoutNoise) {
    for (const std::string name : {"spheres", "spin", "crossing", "dolly", "butterflies"}) {
        const Scene scene = load(name);
        ASSERT_EQ(scene.lights.size(), 1u) << name;
        EXPECT_EQ(scene.lights[0].kind, LightKind::distant) << name;
        EXPECT_TRUE(scene.areaLights.empty()) << name;
        EXPECT_EQ(scene.maxDepth, 1) << name;
        EXPECT_EQ(scene.filter.kind, FilterKind::box) << name;
    }
}

TEST(Scenes, haveWhatTheyAreFor) {
    const auto movers = [](const Scene& scene) {
        return std::ranges::count_if(scene.shapes, [](const Shape& s) { return s.worldFromObject.moves(); });
    };
    const Scene spheres = load("spheres");
    EXPECT_EQ(movers(spheres), 0);
    EXPECT_EQ(std::ranges::count(spheres.shapes, ShapeKind::sphere, &Shape::kind), 100);
    EXPECT_EQ(movers(load("spin")), 10) << "the parts of the wheel";
    EXPECT_EQ(movers(load("crossing")), 20);
    EXPECT_EQ(movers(load("butterflies")), 2 * 210) << "wings";
    EXPECT_EQ(load("shadows").areaLights.size(), 2u);
    const Scene stillLife = load("still-life");
    EXPECT_EQ(movers(stillLife), 1);
    EXPECT_EQ(std::ranges::count(stillLife.materials, MaterialKind::dielectric, &Material::kind), 2);
    EXPECT_TRUE(
        std::ranges::any_of(stillLife.materials, [](const Material& m) { return m.displacement >= 0; }));
    const Scene dolly = load("dolly");
    EXPECT_EQ(movers(dolly), 0);
    EXPECT_TRUE(dolly.camera.worldFromCamera.moves());
}

} // namespace
} // namespace slant

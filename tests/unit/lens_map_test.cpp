// The lens map: against exact rays through the lens, and in its use by outputs, lists and samples.
#include "camera/compound_lens.h"
#include "camera/disc.h"
#include "camera/lens_distortion.h"
#include "reconstruct/lens_tiles.h"
#include "reconstruct/plan.h"
#include "support/lenses.h"

#include <gtest/gtest.h>
#include <random>

namespace slant {
namespace {

constexpr glm::ivec2 kSize(480, 270);

/// Wide open, a field nearly as wide as its image circle.
CompoundLens cameraOf(const std::string& name) {
    Film film;
    film.xResolution = kSize.x;
    film.yResolution = kSize.y;
    film.diagonalMm = name == "fisheye-10mm" ? 24.f : 34.f;
    RealisticCamera camera;
    camera.lens = test::lensNamed(name);
    camera.apertureDiameterMm = camera.lens.surfaces[camera.lens.stop].diameter;
    camera.focusDistance = name == "telephoto-250mm" ? 4 : name == "fisheye-10mm" ? 0.2 : 0.6;
    return CompoundLens(camera, {}, film);
}

struct Draw {
    std::mt19937 random{7};
    std::uniform_real_distribution<float> unit{0, 1};
    glm::vec2 operator()() {
        const float x = unit(random);
        return {x, unit(random)};
    }
};

glm::dvec2 onFilm(const SceneRay& place, glm::dvec2 offset) {
    const glm::dvec3 m = place.filmMetric;
    return {m.x * offset.x + m.y * offset.y, m.y * offset.x + m.z * offset.y};
}

/// The exact ray of a raster position and a place in the unit disc.
std::optional<ScenePath> exactPath(const CompoundLens& camera, glm::vec2 raster, glm::dvec2 disc) {
    const glm::dvec2 offset = glm::dvec2(raster) - camera.filmCentre();
    const double px = glm::length(offset);
    const glm::dvec2 e = offset / px;
    const glm::dmat2 frame(e, glm::dvec2(-e.y, e.x));
    const glm::dvec2 pupil =
        frame * camera.pupil().at(px * camera.millimetresPerPixel(), glm::transpose(frame) * disc);
    return camera.path(raster, pupil / camera.pupil().radius());
}

class LensMapOf : public testing::TestWithParam<const char*> {
protected:
    CompoundLens camera_ = cameraOf(GetParam());
    const LensMap& map_ = camera_.lensMap();
    Draw draw_;
};

TEST_P(LensMapOf, isWithinATenthOfAPixelOfExactRaysAtAnyDepth) {
    std::vector<double> errors;
    for (int i = 0; i < 20000; ++i) {
        const glm::vec2 raster = draw_() * glm::vec2(kSize), square = draw_();
        const glm::vec2 disc = concentricDisc(square.x, square.y);
        const auto path = exactPath(camera_, raster, disc);
        const SceneRay place = map_.at(raster, disc);
        if (!path || !(place.weight > 0)) continue;
        const glm::dvec2 xy = camera_.filmCentre() + camera_.sceneRay(path->line),
                         uv = camera_.entrancePupilPlace(path->line);
        for (const float inverse : {0.f, 0.5f, 1.f, 2.f}) { // of the depth in focus
            const double slope = double(camera_.slopeModel()(float(camera_.focusDepth()) / inverse));
            const glm::dvec2 off = glm::dvec2(place.xy) - xy - slope * (glm::dvec2(place.uv) - uv);
            errors.push_back(glm::length(onFilm(place, off)));
        }
    }
    ASSERT_GT(errors.size(), 75000u);
    std::sort(errors.begin(), errors.end());
    EXPECT_LT(errors[errors.size() * 95 / 100], 0.05);
    EXPECT_LT(errors[errors.size() * 999 / 1000], 0.1);
    EXPECT_LT(errors.back(), 0.3);
}

TEST_P(LensMapOf, metricTurnsShortWaysIntoThoseOnTheFilm) {
    for (int i = 0; i < 2000; ++i) {
        const glm::vec2 raster = glm::vec2(20) + draw_() * glm::vec2(kSize - 40),
                        step = 8.f * (draw_() - 0.5f);
        const SceneRay here = map_.at(raster, {0, 0}), there = map_.at(raster + step, {0, 0});
        if (!(here.weight > 0 && there.weight > 0)) continue;
        const glm::dvec2 way = onFilm(here, there.xy - here.xy);
        EXPECT_LT(glm::length(way - glm::dvec2(step)), 0.05 + 0.08 * double(glm::length(step)));
        EXPECT_LE(std::abs(there.xy.x - here.xy.x), 1.1f * glm::length(step) * here.extent.x + 0.1f);
        EXPECT_LE(std::abs(there.xy.y - here.xy.y), 1.1f * glm::length(step) * here.extent.y + 0.1f);
    }
}

TEST_P(LensMapOf, tilesSeeTheBricksOfWhatTheirOutputsSee) {
    const OutputPattern pattern = makeOutputPattern(64, 8);
    OutputLayout layout{};
    layout.regionOrigin = {-3, -2};
    layout.regionSize = kSize + 6;
    layout.tileCount = (layout.regionSize + kTileSize - 1) / kTileSize;
    layout.outputsPerPixel = 64;
    GridLayout grid{};
    grid.origin = {-3000, -3000};
    grid.invCell = 0.5f;
    grid.cellsPerBrick = 8;
    grid.brickCount = {375, 375};
    grid.bucketCount = 40;
    grid.slopeMin = -15;
    grid.invBucket = 1;
    constexpr float kMarginPx = 1.5f;
    const LensTiles tiles = lensTilesOf(map_, pattern, 0, pattern.groups.size(), grid, layout, kMarginPx);
    Bins bins;
    bins.grid = grid;
    double meeting = 0, seen = 0;
    int looked = 0;
    for (int i = 0; i < 20000; ++i) {
        const ivec2 position(draw_() * glm::vec2(layout.regionSize));
        const int index = int(draw_().x * 64);
        Output output = outputAt(layout.regionOrigin + position, index, pattern, 5);
        toSceneSide(map_, output);
        if (!(output.weight > 0)) continue;
        // A brick of one cell that holds a sample which the output can use.
        const float slope = grid.slopeMin + 40 * draw_().x, wide = 0.5f * draw_().x;
        const glm::vec2 circle = concentricDisc(draw_().x, draw_().y);
        const glm::vec2 p = output.xy - slope * output.uv + kMarginPx * 0.7f * circle * output.extent;
        const ivec2 cell((p - grid.origin) * grid.invCell);
        if (cell.x < 1 || cell.y < 1 || cell.x >= 2999 || cell.y >= 2999) continue;
        const uint place = uint(cell.x | cell.y << 16);
        bins.bricks = {{place, uint(kRadiusSteps) << 12, slope - wide, slope + wide}};
        const TileRange range = tilesOfCompoundLens(bins, 0, layout, tiles.bounds,
                                                    std::size_t(index / pattern.groupSize()), vec2(0));
        const ivec2 tile = position / kTileSize;
        const auto sees = [&](ivec2 t) {
            const int list =
                (index / pattern.groupSize() * layout.tileCount.y + t.y) * layout.tileCount.x + t.x;
            return listSees(bins, 0, tiles, std::size_t(list), vec2(0));
        };
        ASSERT_TRUE(sees(tile)) << position.x << " " << position.y << " slope " << slope;
        ASSERT_TRUE(tile.x >= range.first.x && tile.x < range.last.x && tile.y >= range.first.y &&
                    tile.y < range.last.y)
            << position.x << " " << position.y << " slope " << slope;
        meeting += double(range.last.x - range.first.x) * (range.last.y - range.first.y);
        for (int y = range.first.y; y < range.last.y; ++y)
            for (int x = range.first.x; x < range.last.x; ++x) seen += sees({x, y});
        ++looked;
    }
    ASSERT_GT(looked, 15000);
    EXPECT_LT(meeting / looked, std::string(GetParam()) == "fisheye-10mm" ? 80 : 40) << "tiles per brick";
    EXPECT_LT(seen / looked, 12);
}

TEST_P(LensMapOf, distortionTakesPinholePositionsBackToTheFilm) {
    const LensDistortion distortion(map_, 560);
    for (int i = 0; i < 20000; ++i) {
        const glm::vec2 raster = (2.f * draw_() - 0.5f) * glm::vec2(kSize); // beyond the image, too
        const SceneRay ray = distortion.pinhole().at(raster, {0, 0});
        ASSERT_GT(ray.weight, 0);
        ASSERT_EQ(ray.uv, glm::vec2(0));
        ASSERT_LT(glm::length(distortion.onFilm(ray.xy) - raster), 0.005f) << raster.x << " " << raster.y;
        const SceneRay real = map_.at(raster, draw_() - 0.5f);
        if (!(real.weight > 0)) continue;
        ASSERT_LT(glm::length(distortion.onFilm(real.xy) - raster),
                  1.01f * distortion.aberrationPx() + 0.02f);
        ASSERT_LE(glm::length(real.uv), distortion.pupilReach());
    }
}

TEST_P(LensMapOf, samplesOnTheScenesSideKeepTheRadianceOfTheScene) {
    LightField field;
    field.bounds = field.frame = {0, 0, 2, 1};
    field.samplesPerPixel = 1;
    field.slopeModel = camera_.slopeModel();
    field.lensMap = map_;
    const float bright = map_.at({100.5f, 70.5f}, {0, 0}).weight;
    field.samples = {{100.5f, 70.5f, 0, 0, 0, 1, 0.25f, 1}, {-5000, 0, 0, 0, 0, 1, 0.25f, 1}};
    field.radiance = {{bright, 2 * bright, 0}, {3, 3, 3}};
    const SceneSideSamples sceneSide(field);
    const glm::vec3 radiance = sceneSide.value(ValuePlane::radiance, 0);
    EXPECT_NEAR(radiance.r, 1, 1e-6);
    EXPECT_NEAR(radiance.g, 2, 1e-6);
    EXPECT_EQ(sceneSide.samples()[0].slope, 0.25f);
    EXPECT_GT(sceneSide.areaExcess()[0], -0.5f);
    EXPECT_TRUE(std::isnan(sceneSide.samples()[1].slope)) << "where the film is dark";
    EXPECT_EQ(sceneSide.value(ValuePlane::radiance, 1), glm::vec3(0));
    EXPECT_EQ(SceneSideSamples(field, false).value(ValuePlane::radiance, 0), field.radiance[0]);
}

INSTANTIATE_TEST_SUITE_P(Lenses, LensMapOf,
                         testing::Values("dgauss-50mm", "wide-22mm", "telephoto-250mm", "fisheye-10mm"),
                         [](const auto& lens) {
                             const std::string name = lens.param;
                             return name.substr(0, name.find('-'));
                         });

} // namespace
} // namespace slant

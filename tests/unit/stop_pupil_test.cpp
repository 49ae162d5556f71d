// Shapes at the stop of a real lens: brightness by pbrt's formula, where rays cross the stop, and the map.
#include "camera/camera.h"
#include "camera/lens_distortion.h"
#include "support/lenses.h"

#include <gtest/gtest.h>
#include <random>

namespace slant {
namespace {

CompoundLens cameraOf(const std::string& lens, const std::string& shape, double open) {
    Film film;
    film.xResolution = 480;
    film.yResolution = 270;
    film.diagonalMm = lens == "fisheye-10mm" ? 24.f : 34.f;
    RealisticCamera camera;
    camera.lens = test::lensNamed(lens);
    camera.apertureDiameterMm = open * camera.lens.surfaces[camera.lens.stop].diameter;
    camera.focusDistance = lens == "telephoto-250mm" ? 4 : lens == "fisheye-10mm" ? 0.2 : 0.6;
    camera.aperture = parseAperture(shape, {}).value();
    return CompoundLens(camera, {}, film);
}

/// Where a ray from a raster position to one of the rear plane crosses the stop, in units of its radius;
/// nothing if a rim blocks it.
std::optional<glm::dvec2> stopPlace(const CompoundLens& camera, LensRay ray) {
    LensRay toStop = ray;
    if (!camera.lens().traceFromFilm(ray) || !camera.lens().traceToStop(toStop, {})) return std::nullopt;
    return glm::dvec2(toStop.origin) / camera.lens().stopRadius();
}

/// pbrt-v4's estimate of the irradiance under radiance 1 (RealisticCamera::GenerateRay): rays to a square
/// around the rear plane, each with cos^4 area / distance^2 and its place of the aperture's image, which is
/// scaled to a mean of pi / 4.
double pbrtIrradiance(const CompoundLens& camera, glm::vec2 raster) {
    constexpr int kSide = 600;
    const glm::dvec2 film = (camera.filmCentre() - glm::dvec2(raster)) * camera.millimetresPerPixel();
    const double half = 1.5 * camera.lens().rearRadius();
    const double scale = 1 / camera.aperture().meanTransmission();
    double sum = 0;
    for (int i = 0; i < kSide; ++i)
        for (int j = 0; j < kSide; ++j) {
            const glm::dvec3 rear(half * (2 * (i + 0.5) / kSide - 1), half * (2 * (j + 0.5) / kSide - 1), 0);
            const LensRay ray = test::rayFromFilm({film, camera.filmZ()}, rear);
            const auto place = stopPlace(camera, ray);
            if (place)
                sum += scale * double(camera.aperture().transmission(*place)) * std::pow(ray.direction.z, 4);
        }
    return sum / (kSide * kSide) * 4 * half * half / (camera.filmZ() * camera.filmZ());
}

double meanWeight(const CompoundLens& camera, glm::vec2 raster) {
    constexpr int kSide = 100;
    double sum = 0;
    for (int i = 0; i < kSide; ++i)
        for (int j = 0; j < kSide; ++j)
            sum += double(camera.sample(raster, (glm::vec2(i, j) + 0.5f) / float(kSide)).weight);
    return sum / (kSide * kSide);
}

struct Case {
    const char *lens, *shape;
    double open;
};
class ShapeAtStop : public testing::TestWithParam<Case> {
protected:
    CompoundLens camera_ = cameraOf(GetParam().lens, GetParam().shape, GetParam().open);
};

TEST_P(ShapeAtStop, isAsBrightAsPbrtsCamera) {
    for (const glm::vec2 raster : {glm::vec2(240, 135), glm::vec2(100, 200), glm::vec2(455, 20)})
        EXPECT_NEAR(meanWeight(camera_, raster) / pbrtIrradiance(camera_, raster), 1, 0.02) << raster.x;
}

TEST_P(ShapeAtStop, mapIsWithinATenthOfAPixelOfExactRays) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> unit(0, 1);
    std::vector<double> errors;
    int open = 0, misjudged = 0;
    for (int i = 0; i < 20000; ++i) {
        const float x = unit(random), y = unit(random), a = unit(random), b = unit(random);
        const glm::vec2 raster(480 * x, 270 * y), stop = camera_.aperture().at({2 * a - 1, 2 * b - 1});
        const SceneRay place = camera_.lensMap().at(raster, stop);
        const glm::dvec2 offset = glm::dvec2(raster) - camera_.filmCentre(), e = glm::normalize(offset);
        const glm::dmat2 frame(e, glm::dvec2(-e.y, e.x));
        const glm::dvec2 pupil =
            frame * camera_.stopPupil()->at(glm::length(offset) * camera_.millimetresPerPixel(),
                                            glm::transpose(frame) * glm::dvec2(stop));
        LensRay ray = test::rayFromFilm({-offset * camera_.millimetresPerPixel(), camera_.filmZ()},
                                        {pupil, camera_.pupil().planeZ()});
        const auto crossed = stopPlace(camera_, ray);
        misjudged += crossed.has_value() != (place.weight > 0);
        if (!crossed || !(place.weight > 0)) continue;
        ++open;
        EXPECT_LT(glm::length(*crossed - glm::dvec2(stop)), 2e-3);
        const auto path = camera_.path(raster, pupil / camera_.pupil().radius());
        ASSERT_TRUE(path);
        for (const float inverse : {0.f, 1.f, 2.f}) { // of the depth in focus
            const double slope = double(camera_.slopeModel()(float(camera_.focusDepth()) / inverse));
            const glm::dvec2 xy = camera_.filmCentre() + camera_.sceneRay(path->line),
                             uv = camera_.entrancePupilPlace(path->line);
            errors.push_back(glm::length(glm::dvec2(place.xy) - xy - slope * (glm::dvec2(place.uv) - uv)));
        }
    }
    ASSERT_GT(open, 4000);
    EXPECT_LT(misjudged, 100) << "at the rims of other surfaces, or the stop's";
    std::sort(errors.begin(), errors.end());
    EXPECT_LT(errors[errors.size() * 95 / 100], 0.05);
    EXPECT_LT(errors[errors.size() * 999 / 1000], 0.15);
}

/// Without rims the fisheye's middle ray looks to the side soon beyond its image: there floats end.
TEST_P(ShapeAtStop, distortionTakesPinholePositionsBackToTheFilm) {
    const LensDistortion distortion(camera_.lensMap(), 560);
    int compared = 0;
    for (int x = -120; x <= 600; x += 7)
        for (int y = -70; y <= 340; y += 7) {
            const vec2 pinhole = distortion.pinhole().at(vec2(x, y), {0, 0}).xy;
            if (!(glm::length(pinhole) < 2e4f)) continue;
            ++compared;
            ASSERT_LT(glm::length(distortion.onFilm(pinhole) - vec2(x, y)), 0.005f) << x << " " << y;
        }
    EXPECT_GT(compared, 4500) << "more than all that has light";
}

std::string nameOf(const testing::TestParamInfo<Case>& info) {
    const std::string lens = info.param.lens, shape = info.param.shape;
    return lens.substr(0, lens.find('-')) + "_" + shape.substr(0, shape.find(' '));
}

INSTANTIATE_TEST_SUITE_P(Lenses, ShapeAtStop,
                         testing::Values(Case{"dgauss-50mm", "star", 1}, Case{"dgauss-50mm", "gaussian", 0.7},
                                         Case{"wide-22mm", "polygon 6 10", 0.9},
                                         Case{"telephoto-250mm", "square", 1},
                                         Case{"fisheye-10mm", "pentagon", 1}),
                         nameOf);

TEST(StopPupil, letsTheDiscsLightThrough) {
    for (const char* lens : test::kLensNames) {
        const CompoundLens camera = cameraOf(lens, "polygon 100", 1);
        for (const glm::vec2 raster : {glm::vec2(240, 135), glm::vec2(60, 60), glm::vec2(470, 10)}) {
            const double r =
                glm::length(glm::dvec2(raster) - camera.filmCentre()) * camera.millimetresPerPixel();
            EXPECT_NEAR(meanWeight(camera, raster) / camera.pupil().irradiance(r), 1, 0.02)
                << lens << raster.x;
        }
    }
}

} // namespace
} // namespace slant

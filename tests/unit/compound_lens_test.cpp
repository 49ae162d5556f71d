// The realistic camera: brightness, pupils, orientation and slopes.
#include "camera/camera.h"
#include "camera/slope_fit.h"
#include "support/expect_error.h"
#include "support/lenses.h"
#include "trace/sample_pass.h"
#include "unit/trace_scenes.h"

#include <gtest/gtest.h>
#include <random>

namespace slant {
namespace {

Film filmOf(float diagonalMm) {
    Film film;
    film.xResolution = 480;
    film.yResolution = 270;
    film.crop = {0, 0, 480, 270};
    film.diagonalMm = diagonalMm;
    return film;
}

struct Case {
    const char* lens;
    double focusDistance; ///< metres
    float diagonalMm;
};
const Case kCases[] = {
    {"dgauss-50mm", 1, 35}, {"wide-22mm", 0.6, 32}, {"telephoto-250mm", 4, 35}, {"fisheye-10mm", 0.4, 20}};

CompoundLens cameraOf(const Case& c, double aperture = 1) {
    RealisticCamera camera;
    camera.lens = test::lensNamed(c.lens);
    camera.apertureDiameterMm = aperture * camera.lens.surfaces[camera.lens.stop].diameter;
    camera.focusDistance = c.focusDistance;
    return CompoundLens(camera, {}, filmOf(c.diagonalMm));
}

/// pbrt-v4's estimate of the irradiance at a film point under radiance 1: all rays to a square around the
/// rear surface, most of them blocked.
double pbrtIrradiance(const CompoundLens& camera, glm::dvec2 film) {
    constexpr int kSide = 500;
    const double half = 1.5 * camera.lens().rearRadius(), z = -camera.filmZ();
    double sum = 0;
    for (int i = 0; i < kSide; ++i)
        for (int j = 0; j < kSide; ++j) {
            const glm::dvec3 rear(half * (2 * (i + 0.5) / kSide - 1), half * (2 * (j + 0.5) / kSide - 1), 0);
            LensRay ray = test::rayFromFilm({film, -z}, rear);
            const double cosine = ray.direction.z;
            if (camera.lens().traceFromFilm(ray)) sum += cosine * cosine * cosine * cosine;
        }
    return sum / (kSide * kSide) * 4 * half * half / (z * z);
}

/// Mean weight and share of blocked samples of a raster position.
std::pair<double, double> meanWeight(const CompoundLens& camera, glm::vec2 raster) {
    constexpr int kSide = 64;
    double sum = 0, blocked = 0;
    for (int i = 0; i < kSide; ++i)
        for (int j = 0; j < kSide; ++j) {
            const CameraSample s =
                camera.sample(raster, {(float(i) + 0.5f) / kSide, (float(j) + 0.5f) / kSide});
            sum += double(s.weight);
            blocked += s.weight == 0;
            EXPECT_LE(glm::length(s.lens), 1.0001f);
        }
    return {sum / (kSide * kSide), blocked / (kSide * kSide)};
}

TEST(CompoundLens, isAsBrightAsPbrtsCameraFromTheCentreToTheCorner) {
    for (const Case& c : kCases) {
        const CompoundLens camera = cameraOf(c);
        for (const glm::vec2 raster :
             {glm::vec2(240, 135), glm::vec2(90, 200), glm::vec2(470, 10), glm::vec2(-40, 135)}) {
            const glm::dvec2 film =
                (glm::dvec2(240, 135) - glm::dvec2(raster)) * camera.millimetresPerPixel();
            const auto [weight, blocked] = meanWeight(camera, raster);
            EXPECT_NEAR(weight / pbrtIrradiance(camera, film), 1, 3e-3) << c.lens << " at " << raster.x;
            EXPECT_EQ(blocked, 0) << c.lens << " at " << raster.x;
        }
    }
}

TEST(CompoundLens, onTheAxisItsIrradianceIsThatOfADisc) {
    for (const Case& c : kCases) {
        const CompoundLens camera = cameraOf(c, 0.5);
        const double tangent = camera.pupil().at(0, {1, 0}).x / (camera.pupil().planeZ() - camera.filmZ());
        const double sine2 = tangent * tangent / (1 + tangent * tangent);
        EXPECT_NEAR(meanWeight(camera, {240, 135}).first / (std::numbers::pi * sine2), 1, 1e-3) << c.lens;
    }
}

TEST(CompoundLens, samplesAreSpreadOverThePupilAsItsLightIs) {
    const CompoundLens camera = cameraOf(kCases[0]);
    const double r = 15; // a cat's eye
    constexpr int kSide = 400;
    const glm::dvec2 centre = camera.pupil().at(r, {0, 0});
    const double cell = camera.pupil().radius() / 6;
    const auto light = [&](glm::dvec2 p) {
        const glm::dvec3 way(p + glm::dvec2(r, 0), camera.pupil().planeZ() - camera.filmZ());
        return way.z * way.z / (glm::dot(way, way) * glm::dot(way, way));
    };
    std::array<int, 225> counts{};
    for (int i = 0; i < kSide; ++i)
        for (int j = 0; j < kSide; ++j) {
            const glm::dvec2 p =
                camera.pupil().at(r, concentricDisc((float(i) + 0.5f) / kSide, (float(j) + 0.5f) / kSide));
            const glm::ivec2 place(glm::floor((p - centre) / cell) + 7.0);
            ASSERT_TRUE(place.x >= 0 && place.x < 15 && place.y >= 0 && place.y < 15);
            ++counts[std::size_t(place.y * 15 + place.x)];
        }
    int full = 0;
    for (int k = 0; k < 225; ++k) {
        const glm::dvec2 p = centre + cell * glm::dvec2(k % 15 - 6.5, k / 15 - 6.5);
        const double expected = kSide * kSide * light(p) * cell * cell / camera.pupil().irradiance(r);
        EXPECT_LT(counts[std::size_t(k)], 1.03 * expected);
        full += counts[std::size_t(k)] > 0.97 * expected;
    }
    EXPECT_GE(full, 16) << "cells wholly inside";
}

TEST(CompoundLens, isSymmetric) {
    for (const Case& c : kCases) {
        const CompoundLens camera = cameraOf(c);
        // Half a turn about the axis: (x, y), (u, v) to their negatives.
        const CameraSample a = camera.sample({300, 60}, {0.3f, 0.9f}),
                           b = camera.sample({180, 210}, {0.7f, 0.1f});
        EXPECT_NEAR(a.weight, b.weight, 1e-6 * a.weight);
        EXPECT_LT(glm::length(a.lens + b.lens), 1e-5f) << c.lens;
        EXPECT_LT(glm::length(glm::vec2(a.ray.direction) + glm::vec2(b.ray.direction)), 1e-5f) << c.lens;
    }
}

TEST(CompoundLens, rasterAndLensRunRightAndDown) {
    for (const Case& c : kCases) {
        const CompoundLens camera = cameraOf(c);
        const auto middle = [&](glm::vec2 raster) { return camera.sample(raster, {0.5f, 0.5f}).ray; };
        EXPECT_NEAR(middle({240, 135}).direction.z, 1, 1e-6);
        EXPECT_GT(middle({340, 135}).direction.x, 0.01f) << c.lens;
        EXPECT_LT(middle({240, 235}).direction.y, -0.01f) << c.lens;
        const CameraSample right = camera.sample({240, 135}, {0.9f, 0.5f}),
                           down = camera.sample({240, 135}, {0.5f, 0.9f});
        EXPECT_GT(right.lens.x, 0.5f);
        EXPECT_GT(down.lens.y, 0.5f);
        // Where they pass a little behind the plane in focus's camera.
        EXPECT_GT(right.ray.origin.x, 0) << c.lens;
        EXPECT_LT(down.ray.origin.y, 0) << c.lens;
    }
}

/// Raster and lens position of a ray from a point in camera space, at depth w, to a place of the entrance
/// pupil's plane (mm); false if it is blocked.
bool seen(const CompoundLens& camera, glm::dvec3 point, glm::dvec2 pupil, glm::dvec2& raster,
          glm::dvec2& lens) {
    const glm::dvec3 from = 1000.0 * point + glm::dvec3(0, 0, camera.depthOrigin());
    LensRay ray = test::rayFromFilm(from, {pupil, camera.depthOrigin()});
    if (!camera.lens().traceFromScene(ray)) return false;
    const auto at = [&](double z) {
        return glm::dvec2(ray.origin + (z - ray.origin.z) / ray.direction.z * ray.direction);
    };
    raster = glm::dvec2(240, 135) - at(camera.filmZ()) / camera.millimetresPerPixel();
    lens = at(camera.pupil().planeZ()) / camera.pupil().radius();
    return true;
}

TEST(CompoundLens, slopesOfSamplesAreTheDirectionsOfTrajectories) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (const Case& c : kCases) {
        const CompoundLens camera = cameraOf(c);
        int checked = 0;
        for (int i = 0; i < 400; ++i) {
            const glm::dvec2 raster(240 + 200 * unit(random), 135 + 120 * unit(random));
            const auto path = camera.path(raster, 0.5 * glm::dvec2(unit(random), unit(random)));
            const double depth = c.focusDistance * std::exp2(2 * unit(random)) + 0.1;
            if (!path) continue;
            const glm::dvec3 point(path->line.at(depth), depth);
            const glm::dvec2 pupil = 1000.0 * path->line.position;
            const double h = 1e-4 * camera.lens().entrancePupil().radius;
            bool through = true;
            glm::dvec2 at[3], lens[3];
            for (int k = 0; k < 3; ++k)
                through &= seen(camera, point, pupil + h * glm::dvec2(k == 1, k == 2), at[k], lens[k]);
            if (!through) continue;
            EXPECT_LT(glm::length(at[0] - raster), 1e-6) << c.lens;
            const glm::dmat2 dx(at[1] - at[0], at[2] - at[0]), du(lens[1] - lens[0], lens[2] - lens[0]);
            const glm::dmat2 expected = dx * glm::inverse(du), slope = slopeMatrix(*path, 1 / depth);
            for (int k = 0; k < 2; ++k)
                EXPECT_LT(glm::length(slope[k] - expected[k]), 0.01 + 1e-3 * glm::length(expected[k]))
                    << c.lens;
            ++checked;
        }
        EXPECT_GT(checked, 250) << c.lens;
    }
}

TEST(CompoundLens, nearerSurfacesHaveSmallerSlopesAndNoneInFocus) {
    for (const Case& c : kCases) {
        const CompoundLens camera = cameraOf(c, 0.4);
        const SlopeModel slope = camera.slopeModel();
        const double focus = c.focusDistance - (camera.depthOrigin() - camera.filmZ()) / 1000;
        EXPECT_NEAR(slope(float(focus)), 0, 1e-4) << c.lens;
        EXPECT_LT(slope(float(0.7 * focus)), -0.15) << c.lens;
        EXPECT_GT(slope(float(2 * focus)), 0.15) << c.lens;
        EXPECT_TRUE(std::isfinite(slope(std::numeric_limits<float>::infinity())));
    }
}

TEST(CompoundLens, beyondTheImageCircleTheFilmIsDark) {
    const CompoundLens camera = cameraOf({"fisheye-10mm", 0.4, 40});
    EXPECT_LT(camera.pupil().imageRadius(), 14);
    const CameraSample corner = camera.sample({3, 3}, {0.5f, 0.5f});
    EXPECT_EQ(corner.weight, 0);
    EXPECT_EQ(camera.lensMap().at({3, 3}, {0, 0}).weight, 0);
}

Scene realisticScene(const Case& c) {
    Scene scene = testing::emptyScene(480, 270);
    scene.film.diagonalMm = c.diagonalMm;
    scene.realistic.emplace();
    scene.realistic->lens = test::lensNamed(c.lens);
    scene.realistic->apertureDiameterMm = scene.realistic->lens.surfaces[scene.realistic->lens.stop].diameter;
    scene.realistic->focusDistance = c.focusDistance;
    return scene;
}

TEST(CompoundLens, tracesCleanLightFields) {
    for (const Case& c : kCases) {
        Scene scene = realisticScene(c);
        scene.film.crop = {230, 120, 254, 136};
        const glm::dvec3 middle(0, 0, 1.5 * c.focusDistance);
        scene.shapes.push_back(testing::sphereShape(0.1f, glm::translate(glm::dmat4(1), middle)));
        SilentMonitor monitor;
        const Tracer tracer(scene, monitor);
        LightField field = traceLightField(tracer, scene, {}, monitor);
        EXPECT_EQ(sanitize(field).total(), 0u) << c.lens;
        // Without the sphere there is radiance 1 all around.
        SampleSet corner;
        corner.resize(64, {});
        tracer.trace({2, 2, 3, 3}, {0, 64}, 64, 0, spansOf(corner), monitor);
        double sum = 0;
        for (const glm::vec3& rgb : corner.radiance) sum += double(rgb.g);
        EXPECT_NEAR(sum / 64 / meanWeight(cameraOf(c), {2.5f, 2.5f}).first, 1, 0.02) << c.lens;
    }
}

TEST(CompoundLens, refusesWhatItCannotDo) {
    Scene scene = realisticScene(kCases[0]);
    scene.realistic->focusDistance = 0.1;
    scene.realistic->focusLocation = {"s.pbrt", 2, 3};
    test::expectError(ErrorCode::badInput, "s.pbrt:2:3: this lens cannot focus at 100 mm",
                      [&] { const Camera camera(scene); });
}

} // namespace
} // namespace slant

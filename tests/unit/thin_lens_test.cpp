#include "camera/disc.h"
#include "camera/thin_lens.h"
#include "unit/trace_scenes.h"

#include <gtest/gtest.h>
#include <random>

namespace slant {
namespace {

using testing::emptyScene;

Scene defocusedScene() {
    Scene scene = emptyScene(480, 270);
    scene.camera.lensRadius = 0.13f;
    scene.camera.focalDistance = 4.5f;
    glm::dmat4 view = glm::translate(glm::dmat4(1), glm::dvec3(1, -2, 3));
    view = glm::rotate(view, 0.7, glm::normalize(glm::dvec3(1, 2, -1)));
    scene.camera.worldFromCamera = testing::still(view);
    return scene;
}

/// Raster position of a point of camera space seen from the lens centre, by pbrt's definition of its camera.
glm::dvec2 pinholeRaster(const Scene& scene, glm::dvec3 p) {
    const PerspectiveCamera& c = scene.camera;
    glm::dvec2 screen = glm::dvec2(p) / (p.z * std::tan(glm::radians(double(c.fovDegrees)) / 2));
    glm::dvec2 size = glm::dvec2(c.screenMax) - glm::dvec2(c.screenMin);
    return {(screen.x - double(c.screenMin.x)) / size.x * scene.film.xResolution,
            (double(c.screenMax.y) - screen.y) / size.y * scene.film.yResolution};
}

TEST(ThinLens, pointsLieOnSlantedLines) {
    Scene scene = defocusedScene();
    ThinLens camera(scene.camera, scene.film);
    SlopeModel slope = camera.slopeModel();
    glm::dmat4 world = scene.camera.worldFromCamera.at[0];
    std::mt19937 random(1);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (int i = 0; i < 2000; ++i) {
        double depth = 2 + 20 * std::abs(unit(random));
        glm::dvec3 p(depth * unit(random), depth * 0.5 * unit(random), depth);
        double angle = std::numbers::pi * unit(random), radius = std::sqrt(std::abs(unit(random)));
        glm::dvec2 lens(radius * std::cos(angle), radius * std::sin(angle));
        glm::dvec2 raster = pinholeRaster(scene, p) + lens * double(slope(float(depth)));
        CameraRay ray = camera.ray(raster, lens);
        glm::dvec3 seen = glm::dvec3(ray.origin) + depth * glm::dvec3(ray.direction);
        glm::dvec3 target(world * glm::dvec4(p, 1));
        EXPECT_LT(glm::length(seen - target) / depth * camera.pixelsPerTangent(), 2e-3) << "point " << i;
    }
}

TEST(ThinLens, raysGoWhereTheApertureIsOpen) {
    Scene scene = defocusedScene();
    for (const char* name : {"star", "polygon 6", "gaussian"}) {
        scene.camera.aperture = *parseAperture(name, {});
        const ThinLens camera(scene.camera, scene.film);
        for (int i = 0; i < 1000; ++i) {
            const glm::vec2 square(float(i % 32) / 32 + 0.01f, float(i / 32) / 32 + 0.01f);
            const CameraSample seen = camera.sample({100, 30}, square);
            EXPECT_EQ(seen.weight, 1);
            EXPECT_GT(camera.aperture().transmission(seen.lens), 0) << name;
            EXPECT_EQ(seen.ray.origin, camera.ray({100, 30}, seen.lens).origin);
        }
    }
}

TEST(ThinLens, slopeIsZeroInFocusAndNegativeBefore) {
    Scene scene = defocusedScene();
    SlopeModel slope = ThinLens(scene.camera, scene.film).slopeModel();
    EXPECT_NEAR(slope(4.5f), 0, 1e-5);
    EXPECT_LT(slope(3.f), 0);
    EXPECT_GT(slope(9.f), 0);
    double s = 270 / (2 * std::tan(glm::radians(30.0)));
    EXPECT_NEAR(slope.c1, -s * 0.13, 1e-3);
    EXPECT_NEAR(slope.c2, s * 0.13 / 4.5, 1e-4);
}

TEST(ThinLens, rasterRunsRightAndDown) {
    Scene scene = emptyScene(200, 100);
    ThinLens camera(scene.camera, scene.film);
    double t = std::tan(glm::radians(30.0));
    glm::vec3 topLeft = camera.ray({0, 0}, {0, 0}).direction,
              centre = camera.ray({100, 50}, {0, 0}).direction;
    EXPECT_NEAR(topLeft.x, -2 * t, 1e-6);
    EXPECT_NEAR(topLeft.y, t, 1e-6);
    EXPECT_NEAR(topLeft.z, 1, 1e-6);
    EXPECT_NEAR(glm::length(centre - glm::vec3(0, 0, 1)), 0, 1e-6);
}

TEST(ThinLens, lensRunsRightAndDown) {
    Scene scene = emptyScene();
    scene.camera.lensRadius = 2;
    scene.camera.focalDistance = 5;
    CameraRay ray = ThinLens(scene.camera, scene.film).ray({32, 24}, {0.25f, 0.75f});
    EXPECT_NEAR(glm::length(ray.origin - glm::vec3(0.5f, -1.5f, 0)), 0, 1e-6);
}

TEST(ThinLens, refusesWhatItCannotDo) {
    auto refuses = [](auto change) {
        Scene scene = emptyScene();
        change(scene);
        try {
            ThinLens(scene.camera, scene.film);
        } catch (const Error& e) {
            return e.code() == ErrorCode::badInput;
        }
        return false;
    };
    EXPECT_TRUE(refuses([](Scene& s) { s.camera.fovDegrees = 180; }));
    EXPECT_TRUE(refuses([](Scene& s) { s.camera.fovDegrees = NAN; }));
    EXPECT_TRUE(refuses([](Scene& s) { s.camera.screenMax.x *= 1.1f; }));
    EXPECT_TRUE(refuses([](Scene& s) { s.camera.screenMax = s.camera.screenMin; }));
    EXPECT_TRUE(refuses([](Scene& s) { s.camera.lensRadius = -1; }));
    EXPECT_TRUE(refuses([](Scene& s) {
        s.camera.lensRadius = 1;
        s.camera.focalDistance = 0;
    }));
    EXPECT_FALSE(refuses([](Scene&) {}));
}

TEST(ConcentricDisc, staysInsideAndMatchesSineAndCosine) {
    for (int i = 0; i <= 64; ++i)
        for (int j = 0; j <= 64; ++j) {
            glm::vec2 p = concentricDisc(float(i) / 64, float(j) / 64);
            EXPECT_LE(p.x * p.x + p.y * p.y, 1.0000002f);
            double x = i / 32.0 - 1, y = j / 32.0 - 1;
            glm::dvec2 exact(0);
            if (x != 0 || y != 0) {
                bool wide = std::abs(x) > std::abs(y);
                double angle =
                    wide ? std::numbers::pi / 4 * y / x : std::numbers::pi / 2 - std::numbers::pi / 4 * x / y;
                exact = (wide ? x : y) * glm::dvec2(std::cos(angle), std::sin(angle));
            }
            EXPECT_LT(glm::length(glm::dvec2(p) - exact), 4e-7);
        }
}

} // namespace
} // namespace slant

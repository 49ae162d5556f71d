// Orthographic and spherical cameras, and lights whose intensity depends on the direction.
#include "camera/camera.h"
#include "support/scene_text.h"
#include "trace/point_profile.h"
#include "trace/tracer.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <numbers>

namespace slant {
namespace {

using test::sceneOf;
using test::worldOf;

Camera cameraOf(const std::string& camera) {
    return Camera(sceneOf("Film \"rgb\" \"integer xresolution\" 40 \"integer yresolution\" 20\n" + camera +
                          "\nWorldBegin\n"));
}

CameraRay rayOf(const Camera& camera, glm::vec2 raster, glm::vec2 square) {
    return camera.visit([&](const auto& kind) { return kind.sample(raster, square).ray; });
}

TEST(Orthographic, raysRunAlongTheAxis) {
    const Camera camera = cameraOf("Translate 0 0 3 Camera \"orthographic\""); // the camera at z = -3
    const CameraRay corner = rayOf(camera, {0, 0}, {0.3f, 0.6f}),
                    inside = rayOf(camera, {30, 15}, {0.5f, 0.5f});
    EXPECT_LT(glm::distance(corner.origin, {-2, 1, -3}), 1e-6f);
    EXPECT_LT(glm::distance(inside.origin, {1, -0.5f, -3}), 1e-6f);
    EXPECT_EQ(corner.direction, glm::vec3(0, 0, 1));
    EXPECT_EQ(camera.slopeModel().c1, 0);
    const glm::dvec3 seen = camera.pinholeFromWorld(0) * glm::dvec4(1, -0.5, 7, 1);
    EXPECT_LT(glm::distance(seen, {30, 15, 1}), 1e-9);
}

TEST(Orthographic, withALensAllRaysMeetInTheFocalPlane) {
    const Camera camera =
        cameraOf("Camera \"orthographic\" \"float lensradius\" 0.5 \"float focaldistance\" 4");
    for (const glm::vec2 square : {glm::vec2(0.1f, 0.2f), glm::vec2(0.9f, 0.5f), glm::vec2(0.5f, 0.99f)}) {
        const CameraRay ray = rayOf(camera, {30, 15}, square);
        EXPECT_LE(glm::length(ray.origin), 0.5f + 1e-6f); // on the lens in the middle, as in pbrt
        EXPECT_LT(glm::distance(ray.origin + 4.f * ray.direction, {1, -0.5f, 4}), 1e-5f);
    }
    // S = 40 pixels / 4 units times the focal distance; c1 = -S A, c2 = S A / f.
    EXPECT_NEAR(camera.slopeModel().c1, -10 * 4 * 0.5, 1e-4);
    EXPECT_NEAR(camera.slopeModel().c2, 10 * 0.5, 1e-5);
}

TEST(Spherical, showsAllDirections) {
    const Camera around = cameraOf("Camera \"spherical\" \"string mapping\" \"equirectangular\"");
    const auto direction = [&](const Camera& camera, glm::vec2 raster) {
        return rayOf(camera, raster, {0.5f, 0.5f}).direction;
    };
    EXPECT_LT(glm::distance(direction(around, {20, 0}), {0, 1, 0}), 1e-6f);   // the top is up
    EXPECT_LT(glm::distance(direction(around, {20, 20}), {0, -1, 0}), 1e-6f); // the bottom is down
    EXPECT_LT(glm::distance(direction(around, {10, 10}), {0, 0, 1}), 1e-6f);  // a quarter: along z
    EXPECT_LT(glm::distance(direction(around, {0, 10}), {1, 0, 0}), 1e-6f);
    const Camera equalArea = cameraOf("Camera \"spherical\"");
    EXPECT_LT(glm::distance(direction(equalArea, {20, 10}), {0, 1, 0}), 1e-6f); // the middle is up
    // Equal areas are equal solid angles: the mean of all directions is 0, beyond the edges too.
    glm::vec3 sum(0);
    for (int y = 0; y < 20; ++y)
        for (int x = 0; x < 40; ++x) sum += direction(equalArea, glm::vec2(x, y) + 0.5f);
    EXPECT_LT(glm::length(sum), 1e-2f);
    EXPECT_LT(glm::distance(direction(equalArea, {-1, 5}), direction(equalArea, {1, 15})), 1e-5f);
}

TEST(Spherical, motionOverTheShutterNeedsAProjection) {
    const Scene scene = sceneOf("Camera \"spherical\" WorldBegin\nActiveTransform EndTime Translate 1 0 0 "
                                "ActiveTransform All Shape \"sphere\"");
    SilentMonitor monitor;
    EXPECT_FALSE(Tracer(scene, monitor).camera().isProjective());
}

/// Integral of the intensity over all directions, by luminance.
double powerOf(const PointProfile& profile, double scale) {
    constexpr int kSteps = 400;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i)
        for (int j = 0; j < kSteps; ++j) {
            const float z = 2 * (float(i) + 0.5f) / kSteps - 1, r = std::sqrt(1 - z * z),
                        phi = 2 * kPi * (float(j) + 0.5f) / kSteps;
            sum += double(luminance(profile.intensity({r * std::cos(phi), r * std::sin(phi), z})));
        }
    return scale * sum * 4 * std::numbers::pi / (kSteps * kSteps);
}

TEST(PointProfile, spotsFadeBetweenTheirCones) {
    const Scene scene =
        worldOf("Rotate 90 0 1 0 LightSource \"spot\" \"rgb I\" [2 3 4] \"point3 from\" [0 0 1] "
                "\"point3 to\" [0 0 3] \"float coneangle\" 40 \"float conedeltaangle\" 10");
    const PointProfile profile(scene, scene.lights[0]);
    const auto at = [&](double degrees) { // z is turned to x
        const double t = degrees * std::numbers::pi / 180;
        return profile.intensity({float(std::cos(t)), float(std::sin(t)), 0}).y;
    };
    EXPECT_FLOAT_EQ(at(0), 3);
    EXPECT_FLOAT_EQ(at(29.9), 3);
    EXPECT_EQ(at(40.1), 0);
    const double cosine = (std::cos(40 * std::numbers::pi / 180) + std::cos(30 * std::numbers::pi / 180)) / 2;
    EXPECT_NEAR(at(std::acos(cosine) * 180 / std::numbers::pi), 1.5, 1e-3); // half way, in cosines
    EXPECT_NEAR(powerOf(profile, 1), double(profile.powerOfOne() * luminance({2, 3, 4})), 0.03);
}

/// Red to the right, green at the top.
Scene withImage(const std::string& kind, int width, int height) {
    Scene scene = worldOf("LightSource \"point\" \"float scale\" 2");
    scene.lights[0].kind = kind == "projection" ? LightKind::projection : LightKind::goniometric;
    scene.lights[0].imageIndex = 0;
    scene.images.push_back(Image::rgb(width, height));
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            scene.images[0].at(x, y, 0) = float(x + 1) / float(width);
            scene.images[0].at(x, y, 1) = float(height - y) / float(height);
            scene.images[0].at(x, y, 2) = 0.25f;
        }
    return scene;
}

TEST(PointProfile, projectionsShowTheirImage) {
    Scene scene = withImage("projection", 8, 4);
    scene.lights[0].fovDegrees = 60;
    const PointProfile profile(scene, scene.lights[0]);
    const float half = std::tan(kPi / 6);
    // x to the right, y up, along z: the first row of the image lies at the top.
    EXPECT_EQ(profile.intensity({1.9f * half, 0.9f * half, 1}), glm::vec3(1, 1, 0.25f));
    EXPECT_EQ(profile.intensity({-1.9f * half, -0.9f * half, 1}), glm::vec3(0.125f, 0.25f, 0.25f));
    EXPECT_EQ(profile.intensity({2.1f * half, 0, 1}), glm::vec3(0));
    EXPECT_EQ(profile.intensity({0, 0, -1}), glm::vec3(0));
    EXPECT_NEAR(powerOf(profile, 1), double(profile.powerOfOne()), 0.02);
    EXPECT_NEAR(luminance(profile.mean()) * 4 * kPi, profile.powerOfOne(), 1e-4);
}

TEST(PointProfile, goniometricImagesHaveTheirMiddleUp) {
    Scene scene = withImage("goniometric", 64, 64);
    scene.images[0].at(32, 32, 2) = 7;
    const PointProfile profile(scene, scene.lights[0]);
    EXPECT_EQ(profile.intensity(glm::normalize(glm::vec3(0.01f, 1, 0.01f))).z, 7);
    EXPECT_NEAR(powerOf(profile, 1) / double(profile.powerOfOne()), 1, 0.01);
}

TEST(PointProfile, powerIsWhatAllDirectionsGet) {
    const Scene scene = worldOf("LightSource \"spot\" \"float power\" 50");
    const Lights lights(scene);
    const PointProfile profile(scene, scene.lights[0]);
    LightSample sample;
    ASSERT_TRUE(lights.sample({{0, 0, 2}, {0, 0, -1}, 0}, 0, {}, sample));
    EXPECT_NEAR(sample.radiance.x, 50 / double(profile.powerOfOne()) / 4, 1e-3);
    EXPECT_TRUE(sample.delta);
}

} // namespace
} // namespace slant

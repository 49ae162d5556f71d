// Alpha, normal maps and bumps against closed forms.
#include "support/scene_text.h"
#include "trace/geometry.h"
#include "trace/materials.h"
#include "trace/pattern.h"
#include "trace/tracer.h"

#include <array>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace slant {
namespace {

using test::worldOf;

const std::string kPlane = "\"point3 P\" [ -1 -1 0  1 -1 0  -1 1 0  1 1 0 ]";

/// Part of many rays down onto the unit square that stop.
double stoppedShare(const Geometry& geometry, float distance = 4) {
    int stopped = 0;
    constexpr int kSteps = 100;
    for (int i = 0; i < kSteps * kSteps; ++i) {
        const Ray ray{
            {-1 + 2 * (float(i % kSteps) + 0.5f) / kSteps, -1 + 2 * (float(i / kSteps) + 0.5f) / kSteps, 2},
            {0, 0, -1},
            distance};
        SurfaceHit hit;
        const bool met = geometry.intersect(ray, hit);
        EXPECT_EQ(met, geometry.occluded(ray)); // the same numbers decide
        if (met) {
            EXPECT_NEAR(hit.t, 2 - hit.position.z, 1e-5f);
        }
        stopped += met;
    }
    return double(stopped) / (kSteps * kSteps);
}

TEST(Alpha, isTheShareOfRaysThatStop) {
    SilentMonitor monitor;
    for (const double alpha : {0.0, 0.3, 0.8, 1.0}) {
        const Scene one = worldOf(fmt::format("Shape \"bilinearmesh\" {} \"float alpha\" {}", kPlane, alpha));
        EXPECT_NEAR(stoppedShare(Geometry(one, monitor)), alpha, 0.015);
        // Three layers, one of them an instance.
        const Scene three =
            worldOf(fmt::format("ObjectBegin \"o\" Shape \"trianglemesh\" \"point3 P\" [ -1 -1 0  3 -1 0  -1 "
                                "3 0 ] \"float alpha\" {1} "
                                "ObjectEnd Translate 0 0 0.5 ObjectInstance \"o\" Translate 0 0 -1\n"
                                "Shape \"bilinearmesh\" {0} \"float alpha\" {1} Translate 0 0 -0.5 Shape "
                                "\"bilinearmesh\" {0} \"float "
                                "alpha\" {1}",
                                kPlane, alpha));
        EXPECT_NEAR(stoppedShare(Geometry(three, monitor)), 1 - std::pow(1 - alpha, 3), 0.015);
    }
}

TEST(Alpha, texturesCutHoles) {
    SilentMonitor monitor;
    const Scene scene =
        worldOf("Texture \"h\" \"float\" \"checkerboard\" \"float uscale\" 2 \"float vscale\" 2 "
                "\"float tex1\" 1 \"float tex2\" 0\n"
                "Shape \"bilinearmesh\" " +
                kPlane + " \"texture alpha\" \"h\"");
    const Geometry geometry(scene, monitor);
    EXPECT_EQ(stoppedShare(geometry), 0.5);
    SurfaceHit hit;
    EXPECT_TRUE(geometry.intersect({{-0.5f, -0.5f, 1}, {0, 0, -1}}, hit));
    EXPECT_FALSE(geometry.intersect({{0.5f, -0.5f, 1}, {0, 0, -1}}, hit));
    EXPECT_FALSE(hit.hit());
    std::array<Ray, 2> rays{Ray{{-0.5f, -0.5f, 1}, {0, 0, -1}}, Ray{{0.5f, -0.5f, 1}, {0, 0, -1}}};
    std::array<std::uint8_t, 2> occluded{};
    geometry.occluded(rays, occluded);
    EXPECT_EQ(occluded[0], 1);
    EXPECT_EQ(occluded[1], 0);
}

TEST(Alpha, invisibleLightsShine) {
    // Straight under a small square light of alpha 0: L area / distance^2 / pi times the reflectance.
    const Scene scene =
        worldOf("AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [100 100 100] "
                "Translate 0 0 4 ReverseOrientation Scale 0.1 0.1 1 Shape \"bilinearmesh\" " +
                kPlane +
                " \"float alpha\" 0 AttributeEnd Material \"diffuse\" \"rgb reflectance\" [1 1 1] "
                "Shape \"bilinearmesh\" " +
                kPlane);
    SilentMonitor monitor;
    const Geometry geometry(scene, monitor);
    const Shading shading(scene);
    SurfaceHit hit;
    EXPECT_FALSE(geometry.intersect({{0, 0, 1}, {0, 0, 1}}, hit));
    ShadingSampler sampler(3, 5);
    double sum = 0;
    for (int i = 0; i < 64; ++i)
        sum += double(tracePath(geometry, shading, {{0, 0, 1}, {0, 0, -1}}, 1, sampler).x);
    EXPECT_NEAR(sum / 64, 100 * 0.04 / 16 / std::numbers::pi, 1e-3);
}

/// The normal that a ray down at (x, y) is scattered by.
glm::vec3 normalAt(const Scene& scene, float x, float y) {
    SilentMonitor monitor;
    SurfaceHit hit;
    if (!Geometry(scene, monitor).intersect({{x, y, 5}, {0, 0, -1}}, hit)) return glm::vec3(0);
    return Materials(scene).bsdf(hit, {0, 0, 1}).normal();
}

TEST(Bumps, areTheSlopesOfTheDisplacement) {
    // A displacement that is the image's: 0 at the left, 1 at the right, linear between the middles of
    // texels.
    Scene scene = worldOf("Texture \"d\" \"float\" \"scale\" \"float tex\" 1 \"float scale\" 0.4\n"
                          "Material \"diffuse\" \"texture displacement\" \"d\"\n"
                          "Shape \"bilinearmesh\" \"point3 P\" [ -1 -1 0  1 -1 0  -1 1 0  1 1 0 ]\n");
    EXPECT_LT(glm::distance(normalAt(scene, 0.1f, 0.2f), {0, 0, 1}), 1e-6f); // the same everywhere: flat
    scene.images.push_back(Image::rgb(4, 1));
    for (int x = 0; x < 4; ++x)
        for (int c = 0; c < 3; ++c) scene.images[0].at(x, 0, c) = float(x) / 4;
    Texture ramp;
    ramp.kind = TextureKind::imagemap;
    ramp.imageIndex = 0;
    ramp.scale = 0.4f;
    ramp.wrap = WrapMode::clamp;
    scene.textures.push_back(ramp);
    scene.materials[1].displacement = int(scene.textures.size()) - 1;
    // It rises by 0.4 per unit of u, and u by 1 per 2 units of the world.
    EXPECT_LT(glm::distance(normalAt(scene, 0.1f, 0.2f), glm::normalize(glm::vec3(-0.2f, 0, 1))), 1e-3f);
    // Turned round, it is the same for who looks at it.
    scene.shapes[0].reverseOrientation = true;
    EXPECT_LT(glm::distance(normalAt(scene, 0.1f, 0.2f), glm::normalize(glm::vec3(0.2f, 0, 1))), 1e-3f);
}

TEST(Bumps, normalMapsTurnNormals) {
    Scene scene = worldOf(
        "Material \"diffuse\"\nShape \"bilinearmesh\" \"point3 P\" [ -1 -1 0  1 -1 0  -1 1 0  1 1 0 ]\n");
    scene.images.push_back(Image::rgb(1, 1));
    const glm::vec3 stored = glm::normalize(glm::vec3(0.3f, -0.2f, 0.9f));
    for (int c = 0; c < 3; ++c) scene.images[0].at(0, 0, c) = 0.5f * stored[c] + 0.5f;
    scene.materials[1].normalMapImage = 0;
    EXPECT_LT(glm::distance(normalAt(scene, 0.3f, 0.4f), stored), 1e-5f); // u along x, v along y
}

} // namespace
} // namespace slant

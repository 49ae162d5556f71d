// The surfaces that rays meet: where, with which normal and parametrisation.
#include "trace/geometry.h"

#include "unit/trace_scenes.h"

#include <gtest/gtest.h>

namespace slant {
namespace {

using testing::ballMesh;
using testing::emptyScene;
using testing::meshShape;
using testing::RandomRays;
using testing::sphereShape;
using testing::still;

TEST(Surfaces, sphereAgreesWithTheQuadraticFormula) {
    Scene scene = emptyScene();
    glm::dmat4 matrix = glm::translate(glm::dmat4(1), glm::dvec3(0.3, -0.2, 0.1));
    scene.shapes.push_back(sphereShape(0.7f, matrix));
    SilentMonitor monitor;
    Geometry geometry(scene, monitor);
    RandomRays rays(7);
    for (int i = 0; i < 5000; ++i) {
        Ray ray = rays.inwards(4);
        glm::dvec3 o = glm::dvec3(ray.origin) - glm::dvec3(matrix[3]), d(ray.direction);
        double a = glm::dot(d, d), b = glm::dot(o, d), c = glm::dot(o, o) - double(0.7f) * double(0.7f);
        double discriminant = b * b - a * c;
        SurfaceHit hit;
        EXPECT_EQ(geometry.intersect(ray, hit), discriminant >= 0);
        EXPECT_EQ(geometry.occluded(ray), discriminant >= 0);
        if (discriminant < 0) continue;
        double t = (-b - std::sqrt(discriminant)) / a;
        EXPECT_NEAR(hit.t, t, 1e-6 * t);
        glm::dvec3 p = glm::dvec3(hit.position) - glm::dvec3(matrix[3]);
        EXPECT_NEAR(glm::length(p), 0.7f, 1e-6);
        EXPECT_LT(glm::length(glm::dvec3(hit.geometricNormal) - glm::normalize(p)), 1e-6);
        double phi = std::atan2(p.y, p.x);
        if (phi < 0) phi += 2 * std::numbers::pi;
        EXPECT_NEAR(hit.uv.x, phi / (2 * std::numbers::pi), 1e-5 / std::hypot(p.x, p.y));
        EXPECT_NEAR(hit.uv.y, 1 - std::acos(p.z / 0.7) / std::numbers::pi, 1e-3);
    }
}

TEST(Surfaces, partialQuadricsKeepWhatPbrtKeeps) {
    Scene scene = emptyScene();
    Shape partial = sphereShape(1, glm::dmat4(1));
    partial.zMin = -0.5f;
    partial.zMax = 0.75f;
    partial.phiMaxDegrees = 270;
    scene.shapes.push_back(partial);
    SilentMonitor monitor;
    Geometry geometry(scene, monitor);
    auto hits = [&](glm::vec3 origin, glm::vec3 target, float& t) {
        SurfaceHit hit;
        bool met = geometry.intersect({origin, target - origin}, hit);
        t = hit.t;
        return met;
    };
    float t;
    EXPECT_TRUE(hits({0, 0, 5}, {0.1f, 0.1f, 0.5f}, t) == false) << "through both cut caps";
    EXPECT_TRUE(hits({5, 0.01f, 0}, {0, 0.01f, 0}, t));
    EXPECT_NEAR(t, 0.8, 1e-4);
    EXPECT_TRUE(hits({0.5f, -5, 0}, {0.5f, 0, 0}, t)) << "through the missing quarter onto the far inside";
    EXPECT_NEAR(t, (5 + std::sqrt(0.75)) / 5, 1e-5);

    Shape disk;
    disk.kind = ShapeKind::disk;
    disk.radius = 2;
    disk.innerRadius = 0.5f;
    disk.height = 1;
    disk.phiMaxDegrees = 180;
    disk.materialIndex = 0;
    scene.shapes = {disk};
    Geometry ring(scene, monitor);
    auto hitsRing = [&](float x, float y, SurfaceHit& hit) {
        return ring.intersect({{x, y, 4}, {0, 0, -1}}, hit);
    };
    SurfaceHit hit;
    EXPECT_FALSE(hitsRing(0.1f, 0.1f, hit));
    EXPECT_FALSE(hitsRing(1, -0.1f, hit));
    EXPECT_FALSE(hitsRing(2.1f, 0.1f, hit));
    ASSERT_TRUE(hitsRing(0, 1, hit));
    EXPECT_NEAR(hit.t, 3, 1e-6);
    EXPECT_NEAR(hit.uv.x, 0.5, 1e-6);
    EXPECT_NEAR(hit.uv.y, 1 / 1.5, 1e-6);
    EXPECT_EQ(hit.geometricNormal, glm::vec3(0, 0, 1));
    EXPECT_NEAR(glm::length(hit.dpdu - glm::vec3(-std::numbers::pi_v<float>, 0, 0)), 0, 1e-5);
}

TEST(Surfaces, mirroringAndReverseOrientationFlipNormals) {
    SilentMonitor monitor;
    for (bool mirror : {false, true})
        for (bool reverse : {false, true}) {
            Scene scene = emptyScene();
            glm::dmat4 matrix = glm::scale(glm::dmat4(1), glm::dvec3(mirror ? -1 : 1, 1, 1));
            Shape ball = sphereShape(1, matrix);
            ball.reverseOrientation = reverse;
            scene.shapes.push_back(ball);
            Mesh mesh;
            mesh.positions = {{-1, -1, 3}, {1, -1, 3}, {0, 2, 3}};
            mesh.indices = {0, 1, 2};
            Shape triangle = meshShape(scene, mesh, matrix);
            triangle.reverseOrientation = reverse;
            scene.shapes.push_back(triangle);
            Geometry geometry(scene, monitor);
            SurfaceHit hit;
            ASSERT_TRUE(geometry.intersect({{0, 0, -5}, {0, 0, 1}}, hit));
            EXPECT_NEAR(hit.geometricNormal.z, mirror != reverse ? 1 : -1, 1e-6);
            ASSERT_TRUE(geometry.intersect({{0, 0, 5}, {0, 0, -1}}, hit));
            // The mirror turns the triangle round in space, and the flip turns its normal back.
            EXPECT_NEAR(hit.geometricNormal.z, reverse ? -1 : 1, 1e-6);
        }
}

TEST(Surfaces, shadingNormalsDecideTheSide) {
    Scene scene = emptyScene();
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.normals = {{0, 0, -1}, {0.6f, 0, -0.8f}, {0, 0.6f, -0.8f}};
    mesh.uvs = {{0, 0}, {2, 0}, {0, 4}};
    mesh.indices = {0, 1, 2};
    scene.shapes.push_back(meshShape(scene, mesh));
    SilentMonitor monitor;
    Geometry geometry(scene, monitor);
    SurfaceHit hit;
    ASSERT_TRUE(geometry.intersect({{0.5f, 0.25f, 2}, {0, 0, -1}}, hit));
    EXPECT_EQ(hit.geometricNormal, glm::vec3(0, 0, -1));
    glm::vec3 expected =
        glm::normalize(0.25f * mesh.normals[0] + 0.5f * mesh.normals[1] + 0.25f * mesh.normals[2]);
    EXPECT_LT(glm::length(hit.shadingNormal - expected), 1e-6f);
    EXPECT_NEAR(hit.uv.x, 1, 1e-6);
    EXPECT_NEAR(hit.uv.y, 1, 1e-6);
    EXPECT_NEAR(glm::dot(hit.dpdu, hit.shadingNormal), 0, 1e-6);
    EXPECT_GT(hit.dpdu.x, 0);
}

TEST(Surfaces, bilinearPatchLiesOnItsSurface) {
    Scene scene = emptyScene();
    Mesh mesh;
    mesh.kind = Mesh::Kind::bilinearPatches;
    mesh.positions = {{-1, -1, 0.8f}, {1, -1, -0.7f}, {-1, 1, -0.5f}, {1, 1, 0.9f}};
    mesh.indices = {0, 1, 2, 3};
    scene.shapes.push_back(meshShape(scene, mesh));
    SilentMonitor monitor;
    Geometry geometry(scene, monitor);
    RandomRays rays(3);
    int met = 0;
    for (int i = 0; i < 3000; ++i) {
        Ray ray = rays.inwards(3);
        SurfaceHit hit;
        bool hits = geometry.intersect(ray, hit);
        EXPECT_EQ(hits, geometry.occluded(ray));
        // By marching: the height of the patch above (x, y) is a product of linear functions.
        auto above = [&](double t) {
            glm::dvec3 p = glm::dvec3(ray.origin) + t * glm::dvec3(ray.direction);
            double u = (p.x + 1) / 2, v = (p.y + 1) / 2;
            double z = (1 - u) * (1 - v) * 0.8 + u * (1 - v) * -0.7 + (1 - u) * v * -0.5 + u * v * 0.9;
            return std::pair(p.z - z, u >= 0 && u <= 1 && v >= 0 && v <= 1);
        };
        double first = INFINITY;
        for (int step = 0; step < 6000 && first == INFINITY; ++step) {
            auto [before, insideBefore] = above(step * 1e-3);
            auto [after, insideAfter] = above((step + 1) * 1e-3);
            if (insideBefore && insideAfter && before * after < 0)
                first = (step + before / (before - after)) * 1e-3;
        }
        if (first == INFINITY) continue;
        ASSERT_TRUE(hits);
        ++met;
        // Marching may step over an edge; the answer may not.
        EXPECT_LT(hit.t, first + 2e-3);
        EXPECT_NEAR(above(hit.t).first, 0, 1e-5);
        EXPECT_NEAR(hit.uv.x, (hit.position.x + 1) / 2, 1e-5);
        EXPECT_NEAR(hit.uv.y, (hit.position.y + 1) / 2, 1e-5);
        EXPECT_NEAR(glm::dot(hit.geometricNormal, hit.dpdu), 0, 1e-5);
    }
    EXPECT_GT(met, 1000);
}

TEST(Surfaces, flatPatchesKeepTheirParametrisation) {
    Scene scene = emptyScene();
    Mesh mesh; // two trapezoids side by side
    mesh.kind = Mesh::Kind::bilinearPatches;
    mesh.positions = {{-1, -1, 0}, {0, -1, 0}, {-0.5f, 1, 0}, {0, 1, 0}, {1, -1, 0}, {0.25f, 1, 0}};
    mesh.indices = {0, 1, 2, 3, 1, 4, 3, 5};
    glm::dmat4 place =
        glm::rotate(glm::translate(glm::dmat4(1), glm::dvec3(7, -3, 20)), 0.8, glm::dvec3(0.6, 0, 0.8));
    scene.shapes.push_back(meshShape(scene, mesh, place));
    SilentMonitor monitor;
    Geometry geometry(scene, monitor);
    RandomRays rays(4);
    for (int i = 0; i < 4000; ++i) {
        float u = std::uniform_real_distribution<float>(0, 1)(rays.random),
              v = std::fmod(float(i) * 0.618034f, 1.f);
        const std::uint32_t* c = &mesh.indices[i % 2 ? 4 : 0];
        glm::vec3 p = (1 - u) * ((1 - v) * mesh.positions[c[0]] + v * mesh.positions[c[2]]) +
                      u * ((1 - v) * mesh.positions[c[1]] + v * mesh.positions[c[3]]);
        glm::vec3 target = transformPoint(place, p), direction = rays.direction();
        if (std::abs(glm::dot(direction, glm::vec3(place[2]))) < 0.1f) continue;
        SurfaceHit hit;
        ASSERT_TRUE(geometry.intersect({target - 3.f * direction, direction}, hit));
        EXPECT_LT(glm::length(hit.position - target), 4e-5f);
        if (std::min(u, 1 - u) < 1e-4f) continue; // which of the two is open
        EXPECT_LT(glm::length(hit.uv - glm::vec2(u, v)), 1e-4f);
        EXPECT_NEAR(std::abs(glm::dot(hit.geometricNormal, glm::vec3(place[2]))), 1, 1e-5);
        glm::vec3 normal =
            glm::dot(direction, hit.geometricNormal) > 0 ? -hit.geometricNormal : hit.geometricNormal;
        glm::vec3 origin = offsetRayOrigin(hit.position, hit.positionError, normal, -direction);
        EXPECT_FALSE(geometry.occluded({origin, -direction}));
        EXPECT_FALSE(geometry.occluded(
            {offsetRayOrigin(hit.position, hit.positionError, normal, direction), direction}));
    }
}

} // namespace
} // namespace slant

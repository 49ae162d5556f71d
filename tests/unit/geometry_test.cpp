#include "trace/geometry.h"

#include "unit/trace_scenes.h"

#include <gtest/gtest.h>
#include <random>

namespace slant {
namespace {

using testing::ballMesh;
using testing::emptyScene;
using testing::meshShape;
using testing::sphereShape;
using testing::still;

struct RandomRays {
    std::mt19937 random;
    std::normal_distribution<float> normal;

    explicit RandomRays(unsigned seed) : random(seed) {}
    glm::vec3 direction() {
        return glm::normalize(glm::vec3(normal(random), normal(random), normal(random)));
    }
    /// From a sphere of that radius towards a point within the unit ball or so.
    Ray inwards(float radius) {
        glm::vec3 origin = radius * direction();
        return {origin, glm::normalize(0.8f * direction() - origin)};
    }
};

TEST(Geometry, SphereAgreesWithTheQuadraticFormula) {
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

TEST(Geometry, PartialQuadricsKeepWhatPbrtKeeps) {
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

TEST(Geometry, MirroringAndReverseOrientationFlipNormals) {
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

TEST(Geometry, ShadingNormalsDecideTheSide) {
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

TEST(Geometry, BilinearPatchLiesOnItsSurface) {
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

TEST(Geometry, FlatPatchesKeepTheirParametrisation) {
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

TEST(Geometry, ClosedMeshesLeakNowhere) {
    SilentMonitor monitor;
    for (auto kind : {Mesh::Kind::triangles, Mesh::Kind::bilinearPatches}) {
        Scene scene = emptyScene();
        Mesh ball = ballMesh(20, kind);
        scene.shapes.push_back(meshShape(scene, ball, glm::rotate(glm::dmat4(1), 0.3, glm::dvec3(1, 1, 0))));
        Geometry geometry(scene, monitor);
        RandomRays rays(5);
        for (int i = 0; i < 20000; ++i) {
            // Half of them aimed at vertices and edges; not at the poles, where edges have no length.
            std::size_t corners = ball.positions.size() - 80, index = 40 + std::size_t(i) % corners;
            glm::dvec3 corner = ball.positions[index], next = ball.positions[40 + (index - 39) % corners];
            glm::vec3 target(glm::dmat3(scene.shapes[0].worldFromObject.at[0]) *
                             (i % 4 ? (corner + next) / 2.0 : corner));
            glm::vec3 origin = 0.3f * rays.direction();
            Ray ray{origin, i % 2 ? target - origin : rays.direction()};
            SurfaceHit hit;
            EXPECT_TRUE(geometry.intersect(ray, hit)) << int(kind) << " ray " << i;
            EXPECT_TRUE(geometry.occluded(ray)) << int(kind) << " ray " << i;
        }
    }
}

TEST(Geometry, InstancesEqualTransformedShapes) {
    glm::dmat4 place =
        glm::rotate(glm::translate(glm::dmat4(1), glm::dvec3(0.2, 0.1, -0.3)), 1.1, glm::dvec3(0, 0.6, 0.8));
    place = glm::scale(place, glm::dvec3(-0.5, 0.7, 0.6));
    Scene direct = emptyScene(), instanced = emptyScene();
    instanced.objects.resize(1);
    auto add = [&](Shape shape, const Mesh* mesh) {
        if (mesh) {
            direct.meshes.push_back(*mesh);
            instanced.meshes.push_back(*mesh);
            shape.meshIndex = int(direct.meshes.size()) - 1;
        }
        instanced.objects[0].shapes.push_back(shape);
        shape.worldFromObject = still(place * shape.worldFromObject.at[0]);
        direct.shapes.push_back(shape);
    };
    Mesh triangles = ballMesh(8, Mesh::Kind::triangles), patches = ballMesh(8, Mesh::Kind::bilinearPatches);
    glm::dmat4 one(1);
    Shape mesh;
    mesh.materialIndex = 0;
    mesh.worldFromObject = still(glm::translate(one, glm::dvec3(0.5, 0.5, 0.5)));
    add(mesh, &triangles);
    mesh.worldFromObject = still(glm::translate(one, glm::dvec3(-0.5, -0.5, 0.5)));
    add(mesh, &patches);
    add(sphereShape(0.8f, glm::translate(one, glm::dvec3(-0.5, 0.5, -0.5))), nullptr);
    ObjectInstance instance{0, still(place)};
    instanced.instances.push_back(instance);

    SilentMonitor monitor;
    Geometry a(direct, monitor), b(instanced, monitor);
    RandomRays rays(11);
    int met = 0, differ = 0;
    for (int i = 0; i < 20000; ++i) {
        Ray ray = rays.inwards(3);
        SurfaceHit hitA, hitB;
        bool metA = a.intersect(ray, hitA), metB = b.intersect(ray, hitB);
        if (metA != metB || (metA && std::abs(hitA.t - hitB.t) > 1e-3f)) {
            ++differ; // a silhouette by a hair
            continue;
        }
        if (!metA) continue;
        ++met;
        EXPECT_LT(glm::length(hitA.position - hitB.position), 2e-5f);
        EXPECT_LT(glm::length(hitA.uv - hitB.uv), 2e-3f);
        // Mirrored: pbrt flips a shape's normal by the transform of the shape, not by that of the instance.
        float side = glm::dot(hitA.geometricNormal, hitB.geometricNormal);
        EXPECT_GT(std::abs(side), 0.999f);
    }
    EXPECT_GT(met, 3000);
    EXPECT_LT(differ, 10);
}

TEST(Geometry, PacketsAgreeWithSingleRays) {
    Scene scene = emptyScene();
    for (int i = 0; i < 20; ++i)
        scene.shapes.push_back(
            sphereShape(0.3f, glm::translate(glm::dmat4(1), glm::dvec3(i % 5 - 2, i / 5 - 2, i % 3) * 0.5)));
    scene.shapes.push_back(meshShape(scene, ballMesh(10, Mesh::Kind::triangles)));
    SilentMonitor monitor;
    Geometry geometry(scene, monitor);
    RandomRays rays(2);
    std::vector<Ray> many;
    for (int i = 0; i < 1003; ++i) {
        many.push_back(rays.inwards(4));
        if (i % 7 == 0) many.back().tMax = i % 2 ? 3.f : 0.f;
    }
    std::vector<SurfaceHit> hits(many.size());
    std::vector<std::uint8_t> occluded(many.size());
    geometry.intersect(many, hits);
    geometry.occluded(many, occluded);
    for (std::size_t i = 0; i < many.size(); ++i) {
        SurfaceHit hit;
        bool met = many[i].tMax > 0 && geometry.intersect(many[i], hit);
        EXPECT_EQ(met, hits[i].hit());
        EXPECT_EQ(met, occluded[i] == 1);
        EXPECT_EQ(hit.t, hits[i].t);
        EXPECT_EQ(hit.position, hits[i].position);
    }
}

/// Rays that leave a convex surface outwards, or a closed one inwards to the far side, must not meet where
/// they start.
TEST(Geometry, SpawnedRaysDoNotMeetTheirOwnSurface) {
    SilentMonitor monitor;
    for (double scale : {1e-3, 1.0, 1e3})
        for (int kind = 0; kind < 4; ++kind) {
            Scene scene = emptyScene();
            glm::dmat4 place = glm::translate(glm::dmat4(1), scale * glm::dvec3(3, -50, 20));
            place = glm::scale(glm::rotate(place, 0.5, glm::dvec3(0, 0.6, 0.8)), glm::dvec3(scale));
            Shape shape = sphereShape(1, place);
            if (kind == 1) shape = meshShape(scene, ballMesh(9, Mesh::Kind::triangles), place);
            if (kind == 2) shape = meshShape(scene, ballMesh(9, Mesh::Kind::bilinearPatches), place);
            if (kind == 3) { // an instance
                Shape inside = meshShape(scene, ballMesh(9, Mesh::Kind::triangles));
                scene.objects.push_back({"ball", {inside}});
                scene.instances.push_back({0, still(place)});
            } else {
                scene.shapes.push_back(shape);
            }
            Geometry geometry(scene, monitor);
            RandomRays rays(1);
            int outside = 0;
            for (int i = 0; i < 4000; ++i) {
                glm::vec3 target = place * glm::dvec4(0.9f * rays.direction(), 1);
                Ray ray{glm::vec3(place * glm::dvec4(3.f * rays.direction(), 1)), {}};
                ray.direction = target - ray.origin;
                SurfaceHit hit;
                if (!geometry.intersect(ray, hit)) continue;
                glm::vec3 normal = hit.geometricNormal;
                if (glm::dot(normal, ray.direction) > 0) normal = -normal;
                glm::vec3 direction = rays.direction();
                if (glm::dot(direction, normal) < 0) direction = -direction;
                glm::vec3 origin = offsetRayOrigin(hit.position, hit.positionError, normal, direction);
                // Bilinear patches of a ball are not convex.
                EXPECT_TRUE(kind == 2 || !geometry.occluded({origin, direction})) << kind << " " << scale;
                ++outside;
                origin = offsetRayOrigin(hit.position, hit.positionError, normal, -normal);
                SurfaceHit far;
                EXPECT_TRUE(geometry.intersect({origin, -normal}, far));
                EXPECT_GT(far.t, 0.5f * float(scale)) << kind << " " << scale;
            }
            EXPECT_GT(outside, 2000);
        }
}

TEST(Geometry, BuildingCanBeInterrupted) {
    struct Impatient final : Monitor {
        void beginStage(std::string_view, std::uint64_t, std::string_view) override {}
        void advance(std::uint64_t) override { throw Error(ErrorCode::interrupted, "stop"); }
        void endStage() override {}
        void warn(std::string_view) override {}
    } monitor;
    Scene scene = emptyScene();
    scene.shapes.push_back(meshShape(scene, ballMesh(100, Mesh::Kind::triangles)));
    try {
        Geometry(scene, monitor);
        FAIL();
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), ErrorCode::interrupted);
    }
}

TEST(Geometry, BoundsAndErrors) {
    SilentMonitor monitor;
    Scene scene = emptyScene();
    EXPECT_TRUE(Geometry(scene, monitor).bounds().empty());
    scene.shapes.push_back(sphereShape(2, glm::translate(glm::dmat4(1), glm::dvec3(10, 0, 0))));
    Box box = Geometry(scene, monitor).bounds();
    EXPECT_NEAR(box.min.x, 8, 1e-4);
    EXPECT_NEAR(box.max.x, 12, 1e-4);

    auto refuses = [&](Scene bad) {
        try {
            Geometry(bad, monitor);
        } catch (const Error& e) {
            return e.code() == ErrorCode::badInput;
        }
        return false;
    };
    Scene singular = scene;
    singular.shapes[0].worldFromObject = still(glm::scale(glm::dmat4(1), glm::dvec3(1, 0, 1)));
    EXPECT_TRUE(refuses(singular));
    Scene outOfRange = emptyScene();
    Mesh mesh = ballMesh(3, Mesh::Kind::triangles);
    mesh.indices[5] = 1000;
    outOfRange.shapes.push_back(meshShape(outOfRange, mesh));
    EXPECT_TRUE(refuses(outOfRange));
    Scene moving = scene;
    moving.shapes[0].worldFromObject.at[1][3].x = 1;
    EXPECT_TRUE(refuses(moving));
    EXPECT_FALSE(refuses(scene));
}

} // namespace
} // namespace slant

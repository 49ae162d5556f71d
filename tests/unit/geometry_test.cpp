// What rays meet in a scene, and that nothing leaks.
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

TEST(Geometry, closedMeshesLeakNowhere) {
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

TEST(Geometry, instancesEqualTransformedShapes) {
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
            ++differ; // just at a silhouette
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

TEST(Geometry, packetsAgreeWithSingleRays) {
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
TEST(Geometry, spawnedRaysDoNotMeetTheirOwnSurface) {
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

TEST(Geometry, buildingCanBeInterrupted) {
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

TEST(Geometry, boundsAndErrors) {
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
    Scene vanishing = scene;
    vanishing.shapes[0].worldFromObject.at[1] = glm::scale(glm::dmat4(1), glm::dvec3(1, 0, 1));
    EXPECT_TRUE(refuses(vanishing));
    EXPECT_FALSE(refuses(scene));
}

} // namespace
} // namespace slant

// What moves, seen at one time, is what stands still there.
#include "scene/transforms.h"
#include "trace/geometry.h"
#include "trace/instance.h"
#include "unit/trace_scenes.h"

#include <functional>
#include <gtest/gtest.h>

namespace slant {
namespace {

using testing::ballMesh;
using testing::emptyScene;
using testing::meshShape;
using testing::RandomRays;
using testing::sphereShape;
using testing::still;

const glm::dmat4 kOne(1);

/// A third of a turn about a slanted axis, a step aside and a stretch.
const MovingTransform kTurn{{glm::translate(kOne, glm::dvec3(-0.4, 0, 0)),
                             glm::translate(kOne, glm::dvec3(0.5, 0.3, -0.2)) * rotation(120, {1, 2, 0}) *
                                 glm::scale(kOne, glm::dvec3(1.2, 0.8, 1))}};
const MovingTransform kStep{{kOne, glm::translate(kOne, glm::dvec3(0.7, -0.2, 0.4))}};
/// Within a part of the shutter only, mirrored.
const MovingTransform kLate{{glm::scale(kOne, glm::dvec3(1, 1, -1)),
                             rotation(-70, {0, 1, 0}) * glm::scale(kOne, glm::dvec3(1, 1, -1))},
                            {0.4, 0.7}};

enum class Kind { sphere, disk, triangles, flatPatches, bentPatches };
constexpr Kind kKinds[] = {Kind::sphere, Kind::disk, Kind::triangles, Kind::flatPatches, Kind::bentPatches};

Shape shapeOf(Kind kind, Scene& scene) {
    switch (kind) {
    case Kind::sphere:
    case Kind::disk: {
        Shape shape = sphereShape(0.8f, kOne);
        shape.kind = kind == Kind::disk ? ShapeKind::disk : ShapeKind::sphere;
        return shape;
    }
    case Kind::triangles:
        return meshShape(scene, ballMesh(6, Mesh::Kind::triangles));
    case Kind::bentPatches:
        return meshShape(scene, ballMesh(6, Mesh::Kind::bilinearPatches));
    case Kind::flatPatches:
        break;
    }
    Mesh mesh;
    mesh.kind = Mesh::Kind::bilinearPatches;
    mesh.positions = {{-1, -0.5, 0}, {1, -0.5, 0}, {-1, 0.5, 0.3}, {1, 0.5, 0.3}};
    mesh.indices = {0, 1, 2, 3};
    return meshShape(scene, mesh);
}

/// A scene as `moving` makes it, against the scenes that it is at several times.
void expectLike(const Scene& moving, const std::function<Scene(double)>& frozen, int least) {
    SilentMonitor monitor;
    const Geometry geometry(moving, monitor);
    ASSERT_GT(geometry.moverCount(), 0u);
    int met = 0, differ = 0;
    for (const float time : {0.f, 0.3f, 0.5f, 0.55f, 0.81f, 0.999f}) {
        const Scene now = frozen(double(time));
        const Geometry truth(now, monitor);
        ASSERT_EQ(truth.moverCount(), 0u);
        RandomRays rays(unsigned(time * 100));
        for (int i = 0; i < 3000; ++i) {
            Ray ray = rays.inwards(3);
            ray.time = time;
            SurfaceHit a, b;
            const bool metA = geometry.intersect(ray, a), metB = truth.intersect(ray, b);
            EXPECT_EQ(geometry.occluded(ray), metA);
            if (metA != metB || (metA && std::abs(a.t - b.t) > 1e-3f)) {
                ++differ; // just at a silhouette
                continue;
            }
            if (!metA) continue;
            ++met;
            EXPECT_LT(glm::length(a.position - b.position), 3e-6f);
            EXPECT_GT(std::abs(glm::dot(a.geometricNormal, b.geometricNormal)), 0.9999f);
            EXPECT_LT(glm::length(a.uv - b.uv), 1e-2f);
            EXPECT_EQ(a.time, time);
            EXPECT_EQ(b.mover, -1);
            // It moves as its placement says.
            ASSERT_GE(a.mover, 0);
            const Placement& placement = geometry.placement(a.mover);
            const glm::dvec4 body = affineInverse(placement.at(double(time))) * glm::dvec4(a.position, 1);
            EXPECT_LT(glm::length(body), 4);
        }
    }
    EXPECT_GT(met, least);
    EXPECT_LT(differ, 20);
}

TEST(MovingGeometry, shapesEqualThoseThatStandWhereTheyAre) {
    for (const Kind kind : kKinds)
        for (const MovingTransform& motion : {kTurn, kStep, kLate}) {
            Scene scene = emptyScene();
            scene.shapes.push_back(shapeOf(kind, scene));
            const auto frozen = [&](double time) {
                Scene now = scene;
                now.shapes[0].worldFromObject = still(AnimatedTransform(motion).at(time));
                return now;
            };
            Scene moving = scene;
            moving.shapes[0].worldFromObject = motion;
            expectLike(moving, frozen, 500);
        }
}

TEST(MovingGeometry, instancesAndShapesInThemMoveTogether) {
    Scene scene = emptyScene();
    scene.objects.resize(1);
    for (const Kind kind : kKinds) {
        Shape shape = shapeOf(kind, scene);
        shape.worldFromObject = still(glm::scale(
            glm::translate(kOne, glm::dvec3(0.3 * (double(int(kind)) - 2), 0, 0.2)), glm::dvec3(0.3)));
        scene.objects[0].shapes.push_back(shape);
    }
    for (const bool instanceMoves : {true, false})
        for (const bool shapesMove : {true, false}) {
            if (!instanceMoves && !shapesMove) continue;
            Scene moving = scene;
            moving.instances.push_back({0, instanceMoves ? kTurn : still(kOne)});
            const auto inObject = [&](const Shape& shape) {
                MovingTransform result = shape.worldFromObject;
                result.at[1] = kStep.at[1] * result.at[0];
                return result;
            };
            if (shapesMove)
                for (Shape& shape : moving.objects[0].shapes) shape.worldFromObject = inObject(shape);
            const auto frozen = [&](double time) {
                Scene now = scene;
                now.objects.clear();
                for (const Shape& shape : moving.objects[0].shapes) {
                    now.shapes.push_back(shape);
                    now.shapes.back().worldFromObject =
                        still(AnimatedTransform(moving.instances[0].worldFromInstance).at(time) *
                              AnimatedTransform(shape.worldFromObject).at(time));
                }
                return now;
            };
            expectLike(moving, frozen, 500);
        }
}

TEST(MovingGeometry, packetsAgreeWithSingleRaysAndClosedMeshesLeakNowhere) {
    SilentMonitor monitor;
    Scene scene = emptyScene();
    for (int k = 0; k < 3; ++k) { // several that overlap, and one that stands still
        scene.shapes.push_back(meshShape(scene, ballMesh(9, Mesh::Kind::triangles)));
        if (k > 0) scene.shapes.back().worldFromObject = k == 1 ? kTurn : kLate;
    }
    const Geometry geometry(scene, monitor);
    RandomRays rays(4);
    std::vector<Ray> many;
    for (int i = 0; i < 4003; ++i) {
        many.push_back({0.1f * rays.direction() - glm::vec3(0, 0, 0.1f), rays.direction()});
        many.back().time = float(i % 101) / 101;
    }
    std::vector<SurfaceHit> hits(many.size());
    std::vector<std::uint8_t> occluded(many.size());
    geometry.intersect(many, hits);
    geometry.occluded(many, occluded);
    for (std::size_t i = 0; i < many.size(); ++i) {
        SurfaceHit hit;
        ASSERT_TRUE(geometry.intersect(many[i], hit)) << i;
        EXPECT_TRUE(occluded[i]);
        EXPECT_EQ(hit.t, hits[i].t);
        EXPECT_EQ(hit.position, hits[i].position);
        EXPECT_EQ(hit.mover, hits[i].mover);
    }
}

TEST(MovingGeometry, spawnedRaysDoNotMeetTheirOwnSurface) {
    SilentMonitor monitor;
    for (const Kind kind : {Kind::sphere, Kind::triangles}) {
        Scene scene = emptyScene();
        Shape shape = shapeOf(kind, scene);
        const glm::dmat4 away = glm::translate(kOne, glm::dvec3(3, -50, 20));
        shape.worldFromObject = {{away * kTurn.at[0], away * kTurn.at[1]}};
        scene.shapes.push_back(shape);
        const Geometry geometry(scene, monitor);
        RandomRays rays(1);
        int outside = 0;
        for (int i = 0; i < 6000; ++i) {
            const glm::vec3 target = glm::vec3(away[3]) + 0.9f * rays.direction();
            Ray ray{glm::vec3(away[3]) + 3.f * rays.direction(), {}};
            ray.direction = target - ray.origin;
            ray.time = float(i % 97) / 97;
            SurfaceHit hit;
            if (!geometry.intersect(ray, hit)) continue;
            glm::vec3 normal = hit.geometricNormal;
            if (glm::dot(normal, ray.direction) > 0) normal = -normal;
            glm::vec3 direction = rays.direction();
            if (glm::dot(direction, normal) < 0) direction = -direction;
            const glm::vec3 origin = offsetRayOrigin(hit.position, hit.positionError, normal, direction);
            EXPECT_FALSE(
                geometry.occluded({origin, direction, std::numeric_limits<float>::infinity(), ray.time}));
            ++outside;
        }
        EXPECT_GT(outside, 2000);
    }
}

TEST(MovingGeometry, boundsHoldAllOfTheMotion) {
    SilentMonitor monitor;
    Scene scene = emptyScene();
    scene.shapes.push_back(sphereShape(1, kOne));
    scene.shapes[0].worldFromObject.at[1] = glm::translate(kOne, glm::dvec3(10, 0, 0));
    const Box box = Geometry(scene, monitor).bounds();
    EXPECT_LE(box.min.x, -1);
    EXPECT_GE(box.max.x, 11);
    EXPECT_LT(box.max.x, 11.1f);
    EXPECT_LT(box.max.y, 1.1f);
}

TEST(MovingGeometry, emptyObjectsMayMove) {
    SilentMonitor monitor;
    Scene scene = emptyScene();
    scene.objects.resize(1);
    scene.instances.push_back({0, kTurn});
    SurfaceHit hit;
    EXPECT_FALSE(Geometry(scene, monitor).intersect({{0, 0, -5}, {0, 0, 1}}, hit));
}

} // namespace
} // namespace slant

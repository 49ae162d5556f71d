// The motion of samples against points followed by hand, and the overscan that it needs.
#include "scene/transforms.h"
#include "support/lenses.h"
#include "support/scene_text.h"
#include "trace/instance.h"
#include "trace/sample_pass.h"
#include "unit/trace_scenes.h"

#include "base/parallel.h"

#include <cstring>
#include <functional>
#include <gtest/gtest.h>

namespace slant {
namespace {

using testing::emptyScene;
using testing::meshShape;
using testing::sphereShape;
using testing::still;

const glm::dmat4 kOne(1);

/// A ball before a wall, out of focus.
Scene ballScene() {
    Scene scene = emptyScene(64, 48);
    scene.camera.lensRadius = 0.05f;
    scene.camera.focalDistance = 6;
    scene.maxDepth = 1;
    scene.shapes.push_back(sphereShape(0.6f, glm::translate(kOne, glm::dvec3(0.2, 0.1, 3))));
    Mesh wall;
    wall.kind = Mesh::Kind::bilinearPatches;
    wall.positions = {{-2, -2, 5}, {2, -2, 5}, {-2, 2, 5}, {2, 2, 5}};
    wall.indices = {0, 1, 2, 3};
    scene.shapes.push_back(meshShape(scene, wall));
    return scene;
}

MovingTransform stepping(const glm::dmat4& from, glm::dvec3 by) {
    return {{from, glm::translate(kOne, by) * from}};
}

/// The pinhole camera of emptyScene in plain sight, in camera space.
struct Pinhole {
    glm::dvec2 centre;
    double scale;
    explicit Pinhole(const Scene& scene)
        : centre(scene.film.xResolution / 2.0, scene.film.yResolution / 2.0),
          scale(scene.film.yResolution / 2.0 / std::tan(glm::radians(double(scene.camera.fovDegrees) / 2))) {}
    glm::dvec2 raster(glm::dvec3 p) const { return centre + scale * glm::dvec2(p.x, -p.y) / p.z; }
    glm::dvec3 point(glm::dvec2 raster, double depth) const {
        const glm::dvec2 tangent = (raster - centre) / scale;
        return depth * glm::dvec3(tangent.x, -tangent.y, 1);
    }
};

/// Where the motion of a sample takes it.
struct Moved {
    glm::dvec2 pinhole;
    double depth;
};
Moved movedTo(const LightFieldSample& s, const glm::vec3& m, double time) {
    const glm::dvec2 p = glm::dvec2(s.x, s.y) - double(s.slope) * glm::dvec2(s.u, s.v);
    const double w = std::isinf(s.w) ? 1 : double(s.w);
    const glm::dvec3 at = glm::dvec3(p * w, w) + (time - double(s.t)) * glm::dvec3(m);
    return {glm::dvec2(at) / at.z, at.z};
}

SampleSet traceAll(const Tracer& tracer, Rect pixels, int spp = 4) {
    SampleSet set;
    set.resize(pixels.area() * std::size_t(spp), {.motion = true});
    SilentMonitor monitor;
    tracer.trace(pixels, {0, spp}, spp, 5, spansOf(set), monitor);
    return set;
}

/// Expects that every sample moves as `follow(point in camera space, its time, another time)` says.
void expectMoves(const Scene& scene, const std::function<glm::dvec3(glm::dvec3, double, double)>& follow) {
    SilentMonitor monitor;
    const Tracer tracer(scene, monitor);
    EXPECT_TRUE(tracer.moves());
    const SampleSet set = traceAll(tracer, scene.film.crop);
    const Pinhole pinhole(scene);
    for (std::size_t i = 0; i < set.samples.size(); ++i) {
        const LightFieldSample& s = set.samples[i];
        const Moved now = movedTo(s, set.motion[i], double(s.t));
        const glm::dvec3 point = pinhole.point(now.pinhole, now.depth);
        for (const double time : {0.0, 0.4, 1.0}) {
            const glm::dvec3 truth = follow(point, double(s.t), time);
            const Moved moved = movedTo(s, set.motion[i], time);
            EXPECT_LT(glm::length(moved.pinhole - pinhole.raster(truth)), 1e-4) << i;
            EXPECT_NEAR(moved.depth, truth.z, 1e-5 * truth.z);
        }
    }
}

TEST(SampleMotion, ofStepsIsExact) {
    Scene scene = ballScene();
    const glm::dvec3 step(0.4, -0.3, 0.7);
    for (Shape& shape : scene.shapes) shape.worldFromObject = stepping(shape.worldFromObject.at[0], step);
    scene.lights.clear();
    expectMoves(scene, [&](glm::dvec3 p, double from, double to) {
        return p.z == 1 ? p : p + (to - from) * step; // nothing was hit, and the sky stands still
    });
}

TEST(SampleMotion, ofACameraThatStepsIsExact) {
    Scene scene = ballScene();
    const glm::dvec3 step(0.1, 0.2, 1);
    scene.camera.worldFromCamera = stepping(kOne, step);
    expectMoves(scene,
                [&](glm::dvec3 p, double from, double to) { return p.z == 1 ? p : p - (to - from) * step; });
}

TEST(SampleMotion, ofShapesInMovingInstancesIsExact) {
    Scene scene = ballScene();
    const glm::dvec3 step(0.4, -0.3, 0.7), camera(0, 0.1, 0.2);
    scene.objects.push_back({"all", scene.shapes});
    scene.shapes.clear();
    for (Shape& shape : scene.objects[0].shapes)
        shape.worldFromObject = stepping(shape.worldFromObject.at[0], step);
    scene.instances.push_back({0, stepping(kOne, -0.5 * step)});
    scene.camera.worldFromCamera = stepping(kOne, camera);
    expectMoves(scene, [&](glm::dvec3 p, double from, double to) {
        return p.z == 1 ? p : p + (to - from) * (0.5 * step - camera);
    });
}

TEST(SampleMotion, isNoneWhereNothingMoves) {
    Scene scene = ballScene();
    scene.shapes[0].worldFromObject = stepping(scene.shapes[0].worldFromObject.at[0], {1, 0, 0});
    SilentMonitor monitor;
    const Tracer tracer(scene, monitor);
    const SampleSet set = traceAll(tracer, scene.film.crop);
    int moving = 0;
    for (std::size_t i = 0; i < set.samples.size(); ++i) {
        const bool ball = set.samples[i].w < 4;
        EXPECT_EQ(set.motion[i] != glm::vec3(0), ball);
        moving += ball;
    }
    EXPECT_GT(moving, 500);
    EXPECT_FALSE(Tracer(ballScene(), monitor).moves());
    EXPECT_FALSE(traceLightField(Tracer(ballScene(), monitor), ballScene(), {1}, monitor).moves());
}

/// The camera turns about its own place and the wall on an axis of its own.
Scene turningScene() {
    Scene scene = ballScene();
    scene.camera.worldFromCamera = {{rotation(-4, {0, 1, 0}), rotation(5, {0.1, 1, 0.3})}};
    const glm::dmat4 wheel = glm::translate(kOne, glm::dvec3(0.3, 0, 4));
    scene.shapes[1].worldFromObject = {
        {wheel * glm::translate(kOne, glm::dvec3(0, 0, -5)),
         wheel * rotation(60, {0, 0.2, 1}) * glm::translate(kOne, glm::dvec3(0, 0, -5))}};
    return scene;
}

TEST(SampleMotion, ofTurnsIsTheNearestLineAndKnowsWhatItMisses) {
    const Scene scene = turningScene();
    SilentMonitor monitor;
    const Tracer tracer(scene, monitor);
    const SampleMotion motion(tracer.camera(), tracer.geometry());
    const SampleSet set = traceAll(tracer, scene.film.crop);
    const Pinhole pinhole(scene);
    const AnimatedTransform camera(scene.camera.worldFromCamera), wheel(scene.shapes[1].worldFromObject);
    int sky = 0, turning = 0;
    for (std::size_t i = 0; i < set.samples.size(); i += 7) {
        const LightFieldSample& s = set.samples[i];
        const Moved now = movedTo(s, set.motion[i], double(s.t));
        const double own = double(s.t);
        glm::dvec4 world = camera.at(own) * glm::dvec4(pinhole.point(now.pinhole, now.depth), s.alpha);
        SurfaceHit hit;
        Ray ray{{}, {}, 0, s.t};
        ray.direction = glm::vec3(world);
        if (s.alpha > 0) {
            hit.materialIndex = 0;
            hit.position = glm::vec3(world);
            hit.mover = glm::length(glm::dvec3(world) - glm::dvec3(0.2, 0.1, 3)) < 0.601 ? -1 : 0;
        }
        const FittedMotion fitted = motion.of(hit, ray);
        EXPECT_LT(glm::length(fitted.motion - set.motion[i]), 1e-3f * (1 + glm::length(fitted.motion)));
        sky += s.alpha == 0;
        turning += hit.mover == 0;

        const auto truth = [&](double time) {
            glm::dvec4 there = world;
            if (hit.mover == 0) there = wheel.at(time) * affineInverse(wheel.at(own)) * world;
            return glm::dvec3(affineInverse(camera.at(time)) * there);
        };
        const auto cost = [&](glm::vec3 m) { // of the fit
            double sum = 0;
            for (int k = 0; k <= 8; ++k) {
                const glm::dvec3 p = truth(k / 8.0);
                const Moved line = movedTo(s, m, k / 8.0);
                const glm::dvec3 off =
                    (glm::dvec3(line.pinhole, 1) * line.depth - glm::dvec3(pinhole.raster(p), 1) * p.z) / p.z;
                sum += glm::dot(off, off);
            }
            return sum;
        };
        double most = 0;
        for (int k = 0; k <= 100; ++k)
            most = std::max(most, glm::length(movedTo(s, fitted.motion, k / 100.0).pinhole -
                                              pinhole.raster(truth(k / 100.0))));
        EXPECT_NEAR(most, double(fitted.missPx), 0.05 * most + 2e-4);
        for (const glm::vec3 aside : {glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 0.02f)})
            for (const float way : {-0.3f, 0.3f})
                EXPECT_GT(cost(fitted.motion + way * aside), cost(fitted.motion));
    }
    EXPECT_GT(sky, 100);
    EXPECT_GT(turning, 100);
}

TEST(SampleMotion, ofWhatPassesTheEyeIsFinite) {
    Scene scene = emptyScene(32, 24);
    for (const double end : {-0.5, -10.0, -1000.0}) {
        scene.shapes = {sphereShape(0.5f, kOne)};
        scene.shapes[0].worldFromObject = {
            {glm::translate(kOne, glm::dvec3(0.2, 0, 8)), glm::translate(kOne, glm::dvec3(0.2, 0, end))}};
        SilentMonitor monitor;
        const Tracer tracer(scene, monitor);
        const SampleSet set = traceAll(tracer, scene.film.crop, 16);
        int moving = 0;
        for (std::size_t i = 0; i < set.samples.size(); ++i) {
            const glm::vec3& m = set.motion[i];
            EXPECT_TRUE(std::isfinite(m.x + m.y + m.z));
            if (m == glm::vec3(0)) continue;
            EXPECT_NEAR(double(m.z), end - 8, 1e-3 * (8 - end));
            ++moving;
        }
        EXPECT_GT(moving, 3) << end;
        EXPECT_NO_THROW(traceLightField(tracer, scene, {4}, monitor));
    }
}

TEST(SampleMotion, missesAreCounted) {
    MotionMisses misses, more;
    for (int i = 0; i < 990; ++i) misses.add(0);
    for (int i = 0; i < 9; ++i) more.add(3);
    more.add(1e30f);
    misses.add(more);
    EXPECT_EQ(misses.mostPx(), 1e30f);
    EXPECT_LT(misses.quantilePx(0.99), 0.01f);
    EXPECT_GE(misses.quantilePx(0.995), 3);
    EXPECT_LT(misses.quantilePx(0.995), 3.6f);
    EXPECT_EQ(misses.quantilePx(1), 1e30f);
    EXPECT_EQ(MotionMisses().quantilePx(0.5), 0);
}

TEST(SampleMotion, thatIsFarFromStraightIsReported) {
    test::RecordingMonitor monitor;
    const Scene turning = turningScene();
    MotionMisses misses;
    const LightField field = traceLightField(Tracer(turning, monitor), turning, {2}, monitor, &misses);
    EXPECT_EQ(field.motion.size(), field.samples.size());
    EXPECT_GT(misses.mostPx(), 1);
    ASSERT_EQ(monitor.warnings.size(), 1u);
    EXPECT_NE(monitor.warnings[0].find("the straight motion of samples misses by up to"), std::string::npos);

    Scene straight = ballScene();
    straight.camera.worldFromCamera = stepping(kOne, {0.1, 0, 0.2});
    traceLightField(Tracer(straight, monitor), straight, {2}, monitor, &misses);
    EXPECT_LT(misses.mostPx(), 1e-3f);
    EXPECT_EQ(monitor.warnings.size(), 1u);
}

TEST(SampleMotion, doesNotDependOnRectanglesOrThreads) {
    const Scene scene = turningScene();
    SilentMonitor monitor;
    const Tracer tracer(scene, monitor);
    const SampleSet whole = traceAll(tracer, {0, 0, 24, 16});
    const ThreadLimit one(1);
    const Rect part{5, 3, 18, 14};
    const SampleSet again = traceAll(tracer, part);
    std::size_t i = 0;
    for (int y = part.y0; y < part.y1; ++y)
        for (int x = part.x0; x < part.x1; ++x)
            for (int k = 0; k < 4; ++k, ++i) {
                const std::size_t j = std::size_t((y * 24 + x) * 4 + k);
                EXPECT_EQ(std::memcmp(&again.samples[i], &whole.samples[j], sizeof(LightFieldSample)), 0);
                EXPECT_EQ(again.motion[i], whole.motion[j]);
                EXPECT_EQ(again.radiance[i], whole.radiance[j]);
            }
}

/// Through a real lens points move along lines on the scene's side.
TEST(SampleMotion, throughACompoundLensIsThatOfItsSceneSide) {
    Scene scene = ballScene();
    scene.realistic.emplace();
    scene.realistic->lens = test::lensNamed("dgauss-50mm");
    scene.realistic->apertureDiameterMm = 10;
    scene.realistic->focusDistance = 4;
    const glm::dvec3 step(0.3, -0.2, 0.5);
    for (Shape& shape : scene.shapes) shape.worldFromObject = stepping(shape.worldFromObject.at[0], step);
    SilentMonitor monitor;
    const Tracer tracer(scene, monitor);
    const CompoundLens& lens = *tracer.camera().compoundLens();
    const SampleSet set = traceAll(tracer, scene.film.crop);
    // Pixels per tangent, and where depths begin.
    const double scale = lens.pinholeFromCamera()[0].x, origin = (lens.depthOrigin() - lens.filmZ()) / 1000;
    int seen = 0;
    for (std::size_t i = 0; i < set.samples.size(); ++i) {
        const LightFieldSample& s = set.samples[i];
        if (s.alpha == 0) continue;
        const SceneRay ray = lens.lensMap().at({s.x, s.y}, {s.u, s.v});
        if (!(ray.weight > 0)) continue;
        const glm::dvec2 p = glm::dvec2(ray.xy) - double(s.slope) * glm::dvec2(ray.uv);
        const auto seenAt = [&](double time) {
            const glm::dvec3 there =
                glm::dvec3(p * double(s.w), s.w) + (time - double(s.t)) * glm::dvec3(set.motion[i]);
            return glm::dvec3(glm::dvec2(there) / there.z, there.z);
        };
        const glm::dvec2 tangent = (p - lens.filmCentre()) / scale;
        const glm::dvec3 point(double(s.w) * tangent.x, -double(s.w) * tangent.y, double(s.w) + origin);
        for (const double time : {0.0, 1.0}) {
            const glm::dvec3 truth = point + (time - double(s.t)) * step;
            const double depth = truth.z - origin;
            const glm::dvec2 expected = lens.filmCentre() + scale * glm::dvec2(truth.x, -truth.y) / depth;
            EXPECT_NEAR(seenAt(time).z, depth, 1e-4);
            // The map is a table: it knows the lens to some hundredths of a pixel.
            EXPECT_LT(glm::length(glm::dvec2(seenAt(time)) - expected), 0.02);
        }
        ++seen;
    }
    EXPECT_GT(seen, 1000);
}

TEST(SampleMotion, overscanReachesAsFarAsPointsMove) {
    SilentMonitor monitor;
    for (const bool realistic : {false, true}) {
        Scene scene = emptyScene(64, 48);
        scene.camera.lensRadius = 0.02f;
        scene.camera.focalDistance = 4;
        if (realistic) {
            scene.realistic.emplace();
            scene.realistic->lens = test::lensNamed("dgauss-50mm");
            scene.realistic->apertureDiameterMm = 5;
            scene.realistic->focusDistance = 4;
        }
        const double aside = realistic ? 0.8 : 2;
        scene.shapes.push_back(sphereShape(0.2f, kOne));
        const auto boundsOf = [&](const MovingTransform& motion) {
            scene.shapes[0].worldFromObject = motion;
            const Tracer tracer(scene, monitor);
            return traceLightField(tracer, scene, {8}, monitor).bounds;
        };
        const Rect here = boundsOf(still(glm::translate(kOne, glm::dvec3(0, 0, 4))));
        const Rect right = boundsOf(stepping(glm::translate(kOne, glm::dvec3(0, 0, 4)), {2 * aside, 0, 0}));
        // The ball's right rim comes from within the frame as far as it goes.
        const double scale = realistic ? 0 : Pinhole(scene).scale;
        EXPECT_EQ(right.x0, here.x0);
        EXPECT_EQ(right.y0, here.y0);
        if (realistic) {
            EXPECT_GT(right.x1, here.x1 + 10);
        } else {
            EXPECT_NEAR(right.x1, 32 + scale * (2 * aside + 0.2) / 4 + 2, 4);
        }
        const Rect up = boundsOf(stepping(glm::translate(kOne, glm::dvec3(0, 0, 4)), {0, 2 * aside, 0}));
        EXPECT_LT(up.y0, here.y0 - 5);
        EXPECT_EQ(up.y1, here.y1);
    }
}

} // namespace
} // namespace slant

#include "trace/sample_pass.h"

#include "base/parallel.h"
#include "scene/read_scene.h"
#include "support/scene_text.h"
#include "trace/pattern.h"
#include "unit/trace_scenes.h"

#include <atomic>
#include <cstring>
#include <gtest/gtest.h>

namespace slant {
namespace {

using testing::ballMesh;
using testing::emptyScene;
using testing::meshShape;
using testing::sphereShape;

/// A ball in front of a wall, both out of focus.
Scene ballScene(int width, int height) {
    Scene scene = emptyScene(width, height);
    scene.camera.lensRadius = 0.1f;
    scene.camera.focalDistance = 6;
    scene.shapes.push_back(sphereShape(0.6f, glm::translate(glm::dmat4(1), glm::dvec3(0.2, 0.1, 3))));
    scene.shapes.push_back(meshShape(scene, ballMesh(16, Mesh::Kind::triangles),
                                     glm::translate(glm::dmat4(1), glm::dvec3(-1, 0.5, 5))));
    Mesh wall;
    wall.kind = Mesh::Kind::bilinearPatches;
    wall.positions = {{-9, -9, 12}, {9, -9, 12}, {-9, 9, 12}, {9, 9, 12}};
    wall.indices = {0, 1, 2, 3};
    scene.shapes.push_back(meshShape(scene, wall));
    return scene;
}

struct RecordingMonitor final : Monitor {
    std::atomic<std::uint64_t> items{0};
    std::uint64_t total = 0;
    std::vector<std::string> warnings;
    void beginStage(std::string_view, std::uint64_t count, std::string_view) override { total += count; }
    void advance(std::uint64_t count) override { items += count; }
    void endStage() override {}
    void warn(std::string_view message) override { warnings.emplace_back(message); }
};

template <typename T>
bool sameBits(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

SampleSet traceSet(const Tracer& tracer, Rect pixels, int first, int count, int spp,
                   SamplePlanes planes = {}) {
    SampleSet set;
    set.resize(pixels.area() * std::size_t(count), planes);
    SilentMonitor monitor;
    tracer.trace(pixels, {first, count}, spp, 11, spansOf(set), monitor);
    return set;
}

std::vector<LightFieldSample> trace(const Tracer& tracer, Rect pixels, int first, int count, int spp) {
    return traceSet(tracer, pixels, first, count, spp).samples;
}

TEST(Tracer, samplesLieInTheirPixelsAndOnTheirTrajectories) {
    Scene scene = ballScene(37, 23);
    SilentMonitor monitor;
    Tracer tracer(scene, monitor);
    Rect pixels{-3, -2, 41, 25};
    const SampleSet set = traceSet(tracer, pixels, 0, 5, 5);
    const std::vector<LightFieldSample>& samples = set.samples;
    for (const glm::vec3& rgb : set.radiance) EXPECT_TRUE(std::isfinite(rgb.r + rgb.g + rgb.b));
    SlopeModel slope = tracer.camera().slopeModel();
    int near = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const LightFieldSample& s = samples[i];
        std::size_t pixel = i / 5;
        EXPECT_EQ(std::floor(s.x), pixels.x0 + int(pixel % 44));
        EXPECT_EQ(std::floor(s.y), pixels.y0 + int(pixel / 44));
        EXPECT_LE(s.u * s.u + s.v * s.v, 1.000001f);
        EXPECT_TRUE(s.t >= 0 && s.t < 1);
        EXPECT_EQ(s.alpha, s.w < INFINITY ? 1.f : 0.f);
        EXPECT_EQ(s.slope, slope(s.w));
        if (s.w < 3) ++near;
        // The wall is flat.
        EXPECT_TRUE(s.w < 6 || s.alpha == 0 || std::abs(s.w - 12) < 1e-4f) << s.w;
    }
    EXPECT_GT(near, 100);
}

TEST(Tracer, missesLieAtInfinity) {
    Scene scene = emptyScene(8, 8);
    scene.camera.lensRadius = 0.1f;
    scene.camera.focalDistance = 2;
    SilentMonitor monitor;
    Tracer tracer(scene, monitor);
    for (const LightFieldSample& s : trace(tracer, {0, 0, 8, 8}, 0, 2, 2)) {
        EXPECT_EQ(s.w, INFINITY);
        EXPECT_EQ(s.alpha, 0);
        EXPECT_EQ(s.slope, tracer.camera().slopeModel().c2);
    }
}

TEST(Tracer, aSampleDependsOnItsPixelAndIndexAlone) {
    Scene scene = ballScene(37, 23);
    SilentMonitor monitor;
    Tracer tracer(scene, monitor);
    Rect whole{-5, -3, 40, 26}, part{3, 2, 22, 19};
    std::vector<LightFieldSample> all = trace(tracer, whole, 0, 6, 6), some = trace(tracer, part, 2, 3, 6);
    for (int y = part.y0; y < part.y1; ++y)
        for (int x = part.x0; x < part.x1; ++x)
            for (int s = 0; s < 3; ++s) {
                std::size_t i = std::size_t(((y - whole.y0) * whole.width() + x - whole.x0) * 6 + 2 + s);
                std::size_t j = std::size_t(((y - part.y0) * part.width() + x - part.x0) * 3 + s);
                EXPECT_EQ(std::memcmp(&all[i], &some[j], sizeof(LightFieldSample)), 0) << x << " " << y;
            }
    ThreadLimit one(1);
    EXPECT_TRUE(sameBits(all, trace(tracer, whole, 0, 6, 6)));
}

TEST(Tracer, pixelsMayHaveTheirOwnNumbersOfSamples) {
    const Scene scene = ballScene(37, 23);
    SilentMonitor monitor;
    const Tracer tracer(scene, monitor);
    const Rect pixels{-5, -3, 40, 26};
    const std::vector<LightFieldSample> all = trace(tracer, pixels, 0, 6, 6);
    std::vector<std::uint32_t> starts = {0};
    for (std::size_t i = 0; i < pixels.area(); ++i)
        starts.push_back(starts.back() + hashWords(7, std::uint32_t(i)) % 7);
    SampleSet some;
    some.resize(starts.back(), {});
    RecordingMonitor progress;
    tracer.trace(pixels, {.starts = starts}, 6, 11, spansOf(some), progress);
    EXPECT_EQ(progress.items, starts.back());
    for (std::size_t pixel = 0; pixel < pixels.area(); ++pixel)
        for (std::uint32_t i = starts[pixel]; i < starts[pixel + 1]; ++i)
            EXPECT_EQ(
                std::memcmp(&all[6 * pixel + i - starts[pixel]], &some.samples[i], sizeof(LightFieldSample)),
                0);
}

TEST(Tracer, aConvexBodyUnderAConstantSkyShowsItsReflectance) {
    Scene scene = emptyScene(16, 16);
    scene.shapes.push_back(sphereShape(50, glm::translate(glm::dmat4(1), glm::dvec3(0, 0, 60))));
    scene.lights[0].emission = {1, 2, 4};
    scene.maxDepth = 3;
    SilentMonitor monitor;
    auto mean = [&] {
        Tracer tracer(scene, monitor);
        glm::dvec3 sum(0);
        for (const glm::vec3& rgb : traceSet(tracer, {0, 0, 16, 16}, 0, 64, 64).radiance)
            sum += glm::dvec3(rgb);
        return sum / (16.0 * 16.0 * 64.0);
    };
    glm::dvec3 bright = mean();
    EXPECT_NEAR(bright.r, 0.5, 0.01);
    EXPECT_NEAR(bright.g, 1, 0.02);
    EXPECT_NEAR(bright.b, 2, 0.04);
    scene.film.imagingRatio = 3;
    EXPECT_NEAR(mean().r, 3 * bright.r, 1e-3);
    scene.film.maxComponentValue = 0.75f;
    glm::dvec3 clamped = mean();
    EXPECT_NEAR(clamped.b, 0.75, 0.01);
    EXPECT_NEAR(clamped.r, 0.75 / 4, 0.003) << "samples keep their hue";
    scene.maxDepth = 0;
    EXPECT_EQ(mean(), glm::dvec3(0));
}

/// pbrt-v4's imaging ratio is the shutter time times iso / 100, for measured sensors, too: their white has
/// the observer's luminance.
TEST(Tracer, exposesByShutterAndIso) {
    for (const char* sensor : {"cie1931", "canon_eos_5d_mkiv"}) {
        const Scene scene = test::sceneOf(fmt::format(
            "Film \"rgb\" \"integer xresolution\" 16 \"integer yresolution\" 16 \"float iso\" 320\n"
            "\"string sensor\" \"{}\" Camera \"perspective\" \"float shutteropen\" 0.25\n"
            "\"float shutterclose\" 0.75 WorldBegin LightSource \"infinite\" \"rgb L\" [.2 .4 .8]",
            sensor));
        SilentMonitor monitor;
        Tracer tracer(scene, monitor);
        glm::dvec3 sum(0);
        const SampleSet set = traceSet(tracer, {0, 0, 16, 16}, 0, 4, 4);
        for (const glm::vec3& rgb : set.radiance) sum += glm::dvec3(rgb) / double(set.radiance.size());
        EXPECT_NEAR(sum.r, 1.6 * 0.2, 0.01 * 1.6 * 0.2) << sensor;
        EXPECT_NEAR(sum.g, 1.6 * 0.4, 0.01 * 1.6 * 0.4) << sensor;
        EXPECT_NEAR(sum.b, 1.6 * 0.8, 0.01 * 1.6 * 0.8) << sensor;
    }
}

TEST(Tracer, recordsAlbedoAndNormalTowardsTheCamera) {
    Scene scene = ballScene(24, 16);
    SilentMonitor monitor;
    Tracer tracer(scene, monitor);
    Rect pixels{0, 0, 24, 16};
    const SampleSet set = traceSet(tracer, pixels, 0, 2, 2, {.albedo = true});
    for (std::size_t i = 0; i < set.samples.size(); ++i) {
        bool hit = set.samples[i].alpha > 0;
        EXPECT_NEAR(glm::length(set.normal[i]), hit ? 1 : 0, 1e-5);
        EXPECT_NEAR(set.albedo[i].g, hit ? 0.5 : 0, 1e-5);
        EXPECT_LT(set.normal[i].z, 0.3f);
    }
}

TEST(Tracer, refusesBuffersThatDoNotFit) {
    Scene scene = ballScene(8, 8);
    SilentMonitor monitor;
    Tracer tracer(scene, monitor);
    SampleSet set;
    set.resize(64 * 4, {});
    const SampleSpans all = spansOf(set);
    std::vector<glm::vec3> three(3);
    Rect pixels{0, 0, 8, 8};
    EXPECT_THROW(tracer.trace(pixels, {0, 3}, 4, 0, all, monitor), Error);
    EXPECT_THROW(tracer.trace(pixels, {1, 4}, 4, 0, all, monitor), Error);
    EXPECT_THROW(tracer.trace(pixels, {0, 4}, 4, 0, {all.samples, {}, {}, {}}, monitor), Error);
    EXPECT_THROW(tracer.trace(pixels, {0, 4}, 4, 0, {all.samples, all.radiance, three, three}, monitor),
                 Error);
    EXPECT_THROW(tracer.trace(pixels, {0, 4}, 4, 0, {all.samples, all.radiance, all.radiance, {}}, monitor),
                 Error);
    EXPECT_NO_THROW(tracer.trace(pixels, {0, 4}, 4, 0, all, monitor));
    std::vector<std::uint32_t> starts(65);
    for (std::uint32_t i = 0; i < 65; ++i) starts[i] = 4 * i;
    EXPECT_NO_THROW(tracer.trace(pixels, {.starts = starts}, 4, 0, all, monitor));
    EXPECT_THROW(tracer.trace(pixels, {.starts = std::span(starts).first(2)}, 4, 0, all, monitor), Error);
    starts[1] = 5; // more than the pattern has
    EXPECT_THROW(tracer.trace(pixels, {.starts = starts}, 4, 0, all, monitor), Error);
    EXPECT_NO_THROW(tracer.trace({4, 4, 4, 4}, {0, 4}, 4, 0, {}, monitor));
}

TEST(SamplePass, partsOfTheRadianceAddUp) {
    SilentMonitor monitor;
    const Scene scene = readScene(std::string(SLANT_SOURCE_DIR) + "/scenes/indirect.pbrt", monitor);
    const Tracer tracer(scene, monitor);
    const Rect pixels{60, 180, 320, 230}; // floor, walls, coats and copper
    const SampleSet set = traceSet(tracer, pixels, 0, 2, 2, {.shading = true});
    EXPECT_TRUE(sameBits(set.radiance, traceSet(tracer, pixels, 0, 2, 2).radiance));
    ASSERT_EQ(set.normal.size(), set.samples.size());
    EXPECT_TRUE(set.albedo.empty());
    int diffuse = 0, coated = 0, metal = 0;
    for (std::size_t i = 0; i < set.samples.size(); ++i) {
        const glm::vec3 ofDiffuse = set.reflectance[i] * set.illumination[i], rest = set.reflection[i];
        for (int c = 0; c < 3; ++c)
            ASSERT_NEAR(ofDiffuse[c] + rest[c], set.radiance[i][c], 1e-5f + 1e-5f * set.radiance[i][c]) << i;
        diffuse += ofDiffuse != glm::vec3(0) && rest == glm::vec3(0);
        coated += ofDiffuse != glm::vec3(0) && rest != glm::vec3(0);
        metal += set.reflectance[i] == glm::vec3(0) && rest != glm::vec3(0);
    }
    EXPECT_GT(diffuse, 1000);
    EXPECT_GT(coated, 100);
    EXPECT_GT(metal, 100);

    const Rect lamp{230, 8, 250, 12};
    const SampleSet lit = traceSet(tracer, lamp, 0, 2, 2, {.shading = true});
    for (std::size_t i = 0; i < lit.samples.size(); ++i) {
        EXPECT_EQ(lit.illumination[i], glm::vec3(0));
        EXPECT_EQ(lit.reflection[i], glm::vec3(0)) << "what a light emits is not reflected";
        EXPECT_GT(lit.radiance[i].x, 5);
    }
}

TEST(SamplePass, shadowRaysTellWhatArrives) {
    SilentMonitor monitor;
    const Scene scene = readScene(std::string(SLANT_SOURCE_DIR) + "/scenes/shadows.pbrt", monitor);
    const Tracer tracer(scene, monitor);
    const Rect pixels{60, 100, 320, 150};
    const SampleSet set = traceSet(tracer, pixels, 0, 2, 2, {.shading = true, .shadows = true});
    EXPECT_TRUE(sameBits(set.radiance, traceSet(tracer, pixels, 0, 2, 2).radiance));
    int blocked = 0, unblocked = 0;
    for (std::size_t i = 0; i < set.samples.size(); ++i) {
        const glm::vec3 toLight = set.light[i] - set.position[i],
                        toBlocker = set.blocker[i] - set.position[i];
        const bool free = set.blocker[i] == set.light[i];
        ASSERT_EQ(set.illumination[i], free ? set.direct[i] : glm::vec3(0)) << i;
        if (set.direct[i] == glm::vec3(0)) continue;
        (free ? unblocked : blocked) += 1;
        ASSERT_GT(set.light[i].y, 3.5f) << "the lamps";
        ASSERT_LE(glm::length(toBlocker), glm::length(toLight));
        ASSERT_LT(glm::length(glm::cross(toBlocker, toLight)), 1e-4f * glm::dot(toLight, toLight)) << i;
    }
    EXPECT_GT(blocked, 1000);
    EXPECT_GT(unblocked, 1000);
}

TEST(SamplePass, overscanReachesAsFarAsTheBlur) {
    Scene scene = ballScene(64, 48);
    scene.camera.lensRadius = 1;
    RecordingMonitor monitor;
    Tracer tracer(scene, monitor);
    SampleOptions options;
    options.samplesPerPixel = 4;
    options.planes.albedo = true;
    LightField field = traceLightField(tracer, scene, options, monitor);
    EXPECT_EQ(field.frame, scene.film.crop);
    EXPECT_EQ(field.samples.size(), field.bounds.area() * 4);
    EXPECT_EQ(field.radiance.size(), field.samples.size());
    EXPECT_EQ(field.albedo.size(), field.samples.size());
    EXPECT_EQ(field.normal.size(), field.samples.size());
    EXPECT_EQ(monitor.items, field.samples.size());
    EXPECT_EQ(monitor.total, field.samples.size());
    EXPECT_TRUE(monitor.warnings.empty());
    // The wall fills most of the border. A trajectory there reaches once its slope beyond the frame at least,
    // and twice that when it was seen from the far side of the lens; nothing is more blurred than the ball.
    // Then 2 / sqrt(4), and 1 for the pixel filter.
    int least = int(field.slopeModel(12)) + 2, widest = int(std::ceil(-2 * field.slopeModel(2.4f))) + 2;
    for (int side : {field.frame.x0 - field.bounds.x0, field.frame.y0 - field.bounds.y0,
                     field.bounds.x1 - field.frame.x1, field.bounds.y1 - field.frame.y1}) {
        EXPECT_GE(side, least);
        EXPECT_LE(side, widest);
    }
    EXPECT_TRUE(sameBits(field.samples, [&] {
        SampleSet set;
        set.resize(field.samples.size(), {});
        tracer.trace(field.bounds, {0, 4}, 4, options.seed, spansOf(set), monitor);
        return set.samples;
    }()));
}

TEST(SamplePass, overscanIsLimitedWithAWarning) {
    Scene scene = ballScene(32, 24);
    scene.camera.lensRadius = 20;
    RecordingMonitor monitor;
    Tracer tracer(scene, monitor);
    LightField field = traceLightField(tracer, scene, {1}, monitor);
    EXPECT_EQ(field.bounds, field.frame.expand(16));
    ASSERT_EQ(monitor.warnings.size(), 1u);
    EXPECT_NE(monitor.warnings[0].find("16"), std::string::npos);
}

TEST(SamplePass, boundsFollowTheFurthestTrajectoryOnEachSide) {
    LightFieldSample s{};
    s.x = 2.5f, s.y = 5.5f, s.u = 0.5f, s.slope = -3;
    int wanted = 0;
    // The trajectory's disc: centre (4, 5.5), radius 3.
    Rect bounds = boundsWithOverscan({2, 3, 10, 8}, {0, 5}, {{s}}, {}, {}, 16, 100, wanted);
    EXPECT_EQ(bounds, (Rect{2 - 3, 3 - 7, 10 + 2, 8 + 7}));
    EXPECT_EQ(wanted, 7);
    s.slope = NAN;
    EXPECT_EQ(boundsWithOverscan({2, 3, 10, 8}, {1, 1}, {{s}}, {}, {}, 16, 100, wanted),
              (Rect{2, 3, 10, 8}.expand(2)));
}

TEST(SamplePass, overscanHoldsWhatTheFilterSees) {
    Scene scene = ballScene(32, 24);
    scene.camera.lensRadius = 0;
    SilentMonitor monitor;
    Tracer tracer(scene, monitor);
    for (const auto& [radius, reach] : {std::pair(0.5f, 1), {1.5f, 1}, {1.6f, 2}, {8.f, 8}}) {
        scene.filter.radius = {radius, 0.5f};
        const LightField field = traceLightField(tracer, scene, {4}, monitor);
        EXPECT_EQ(field.bounds, (Rect{-reach - 1, -2, 32 + reach + 1, 24 + 2})) << radius;
        EXPECT_EQ(field.frame, scene.film.crop);
    }
}

TEST(SamplePass, refusesWhatDoesNotFitTheBudget) {
    Scene scene = ballScene(64, 48);
    RecordingMonitor monitor;
    Tracer tracer(scene, monitor);
    SampleOptions options;
    options.memoryBytes = 64 * 48 * 8 * sizeof(LightFieldSample) - 1;
    try {
        traceLightField(tracer, scene, options, monitor);
        FAIL();
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), ErrorCode::resources);
    }
    EXPECT_EQ(monitor.items, 0u);
}

} // namespace
} // namespace slant

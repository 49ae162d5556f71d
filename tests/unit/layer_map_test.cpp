// The layer map on light fields whose surfaces are known, and the outputs taken from it.
#include "lib/map_texel.glsl"
#include "reconstruct/map_lookup.h"
#include "reconstruct/plan.h"
#include "support/synthetic.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <numeric>

namespace slant {
namespace {

const Rect kFrame{0, 0, 64, 48};

/// Half plane x < 32 at slope -4 before everything at slope 9, which grows brighter to the right.
std::vector<synthetic::Layer> halfPlane() {
    return {{-4, [](vec2 p) { return p.x < 32; }, [](vec2) { return vec3(0.25f, 0.5f, 1); }},
            {9, [](vec2) { return true; }, [](vec2 p) { return vec3(p.x); }}};
}

struct Fixture {
    Bins bins;
    LayerMap map;
    std::vector<uint> allBricks;

    explicit Fixture(const std::vector<synthetic::Layer>& layers, int spp = 16) {
        const LightField field = synthetic::sample(layers, kFrame, 15, spp, 3);
        const SceneSideSamples samples(field);
        bins = binSamples(samples, {kFrame});
        takeValues(bins, samples, ValuePlane::radiance);
        map = makeLayerMap(bins, chooseMap(bins.grid, {}, kFrame, mapTexelsPerPixel(field),
                                           mapReach(bins.grid, {}, 1), 0.5f));
        allBricks.resize(bins.bricks.size());
        std::iota(allBricks.begin(), allBricks.end(), 0u);
    }

    std::size_t texelAt(vec2 p, int level) const {
        const ivec2 texel = ivec2((p - vec2(map.layout.origin)) * float(map.layout.texelsPerPixel)) >> level;
        return levelBegin(map.layout, level) + std::size_t(texel.y) * levelSize(map.layout, level).x +
               texel.x;
    }
    MapTexel texel(vec2 p, int level) const {
        return unpackTexel(map.texels[texelAt(p, level)], map.layout.code);
    }
    /// Of a list of all bricks.
    ListClass listClass(const LensBox& lens, float reachPx) const {
        MapLayout layout = map.layout;
        layout.reachPx = reachPx;
        return classOfList(bins, allBricks, sightThrough(lens, 1), vec2(0), layout);
    }
};

TEST(LayerMap, texelsHoldWhatIsSeenAndWhatIsHidden) {
    for (const int spp : {1, 16}) {
        const Fixture f(halfPlane(), spp);
        EXPECT_EQ(f.map.layout.texelsPerPixel, spp == 1 ? 1 : 2) << "no closer than samples need";
        ASSERT_GE(f.map.layout.levels, 2);
        for (int level = 0; level < f.map.layout.levels; ++level) {
            SCOPED_TRACE(fmt::format("{} samples per pixel, level {}", spp, level));
            // Seen past the edge from the other side of the lens: hidden at the centre, 4 + 9 px deep.
            const MapTexel edge = f.texel(vec2(24, 24), level);
            ASSERT_EQ(edge.count, 2);
            EXPECT_NEAR(edge.layers[0].slope, -4, 1e-3);
            EXPECT_NEAR(edge.layers[0].rgb.y, 0.5f, 1e-3);
            EXPECT_EQ(edge.layers[0].coverage, 1);
            EXPECT_NEAR(edge.layers[1].slope, 9, 1e-3);
            EXPECT_NEAR(edge.layers[1].rgb.x, 24, 2 << level);

            const MapTexel open = f.texel(vec2(52, 24), level);
            ASSERT_EQ(open.count, 1);
            EXPECT_NEAR(open.layers[0].slope, 9, 1e-3);
            EXPECT_EQ(open.layers[0].coverage, 1);
        }
    }
}

TEST(LayerMap, packingKeepsWhatCounts) {
    GridLayout grid{};
    grid.slopeMin = -40;
    grid.bucketCount = 100;
    grid.invBucket = 1;
    const SlopeCode code = slopeCode(grid);
    for (const float bright : {1e-20f, 0.37f, 1.f, 65000.f, 3e30f})
        for (const float slope : {-40.f, -1.3f, 0.f, 59.9f}) {
            MapTexel texel;
            texel.count = 2;
            texel.layers[0] = {bright * vec3(1, 0.5f, 0.01f), 1, slope};
            texel.layers[1] = {vec3(0), 0.25f, slope};
            const MapTexel back = unpackTexel(packTexel(texel, code), code);
            ASSERT_EQ(back.count, 2);
            for (int i = 0; i < 3; ++i)
                EXPECT_NEAR(back.layers[0].rgb[i], texel.layers[0].rgb[i], bright / 1024);
            EXPECT_EQ(back.layers[0].coverage, 1);
            EXPECT_EQ(back.layers[1].rgb, vec3(0));
            EXPECT_NEAR(back.layers[1].coverage, 0.25f, 0.002);
            EXPECT_NEAR(back.layers[1].slope, slope, code.step);
        }
    EXPECT_EQ(unpackTexel(packTexel(MapTexel{}, code), code).count, 0);
    MapTexel faint;
    faint.layers[0] = {vec3(1), 1e-4f, 2};
    EXPECT_GT(unpackTexel(packTexel(faint, code), code).layers[0].coverage, 0) << "lest means divide by 0";
}

TEST(LayerMap, coverageOfARimIsItsArea) {
    const Fixture f(halfPlane());
    double covered = 0; // the columns around the edge, 8 px wide
    for (float y = 8.25f; y < 40; y += 0.5f)
        for (float x = 28.25f; x < 36; x += 0.5f) {
            const MapLayer front = f.texel(vec2(x, y), 0).layers[0];
            if (front.slope < 0) covered += front.coverage * 0.25;
        }
    EXPECT_NEAR(covered / 32, 4, 0.1);
}

TEST(Layers, clustersAreToldApart) {
    const Fixture f(halfPlane());
    const LensBox lens{vec2(0.5f), vec2(0.7f)};
    const ListClass listClass = f.listClass(lens, 20);
    ASSERT_EQ(listClass.clusters.size(), 2u);
    EXPECT_NEAR(listClass.clusters[0].slopeMin, -4, 1e-4);
    EXPECT_NEAR(listClass.clusters[0].slopeMax, -4, 1e-4);
    EXPECT_NEAR(listClass.clusters[1].slopeMin, 9, 1e-4);
    EXPECT_FALSE(listClass.inFocus);
    EXPECT_TRUE(f.listClass(lens, 8).clusters.empty()) << "reaches further than the map";
    EXPECT_FALSE(f.listClass({vec2(0), vec2(0.5f)}, 8).clusters.empty());
    EXPECT_TRUE(classOfList(f.bins, {}, sightThrough(lens, 1), vec2(0), f.map.layout).clusters.empty());
}

TEST(Layers, whatIsInFocusIsServedWhereSamplesAreNoFinerThanTexels) {
    std::vector<synthetic::Layer> focused = halfPlane();
    focused[0].slope = 0.3f;
    const Fixture coarse(focused, 9);
    const ListClass listClass = coarse.listClass({vec2(0.5f), vec2(0.7f)}, 20);
    EXPECT_EQ(listClass.clusters.size(), 2u);
    EXPECT_TRUE(listClass.inFocus);
    EXPECT_EQ(listClass.code(), 2u | kInFocusBit);
    EXPECT_TRUE(Fixture(focused, 16).listClass({vec2(0.5f), vec2(0.7f)}, 20).clusters.empty());
}

TEST(Layers, raysFindTheirSurfaces) {
    const Fixture f(halfPlane());
    const std::vector<Cluster> clusters = f.listClass({vec2(-1), vec2(1)}, 20).clusters;
    for (const float u : {-0.7f, -0.2f, 0.f, 0.4f, 0.8f})
        for (float x = 8.5f; x < 56; ++x) {
            const float front = x + 4 * u, back = x - 9 * u; // pinhole positions on either layer
            const vec3 rgb = lookThrough(f.map, clusters, {x, 24.5f}, {u, 0.3f}).value();
            if (front < 31) {
                EXPECT_NEAR(rgb.y, 0.5f, 1e-3) << x << ", " << u;
            }
            if (front > 33) {
                EXPECT_NEAR(rgb.y, back, 0.7f) << x << ", " << u;
            }
        }
}

TEST(Layers, whereTheMapHasNothingThereIsNoAnswer) {
    const Fixture f(halfPlane());
    const Cluster elsewhere = stillCluster(20, 21, 0);
    EXPECT_FALSE(lookThrough(f.map, {&elsewhere, 1}, vec2(20, 20), vec2(0.1f)));
}

} // namespace
} // namespace slant

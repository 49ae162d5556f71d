// The layer map on light fields whose surfaces are known, and what is taken from it.
#include "reconstruct/layers.h"
#include "reconstruct/plan.h"
#include "support/synthetic.h"

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

    explicit Fixture(const std::vector<synthetic::Layer>& layers) {
        const LightField field = synthetic::sample(layers, kFrame, 15, 16, 3);
        bins = binSamples(field, kFrame, kSearchRadii * emptyCircleRadius(16));
        map = makeLayerMap(bins, chooseMap(bins.grid, kFrame, mapReach(bins.grid, 1), 0.5f));
        allBricks.resize(bins.bricks.size());
        std::iota(allBricks.begin(), allBricks.end(), 0u);
    }

    std::size_t texelAt(vec2 p, int level) const {
        const ivec2 texel = ivec2((p - vec2(map.layout.origin)) * float(kMapTexels)) >> level;
        return levelBegin(map.layout, level) + std::size_t(texel.y) * levelSize(map.layout, level).x +
               texel.x;
    }
    vec4 head(vec2 p, int level) const { return map.heads[texelAt(p, level)]; }
    vec4 layer(vec2 p, int level, int i) const { return map.layers[texelAt(p, level) * kMapLayers + i]; }
};

TEST(LayerMap, texelsHoldWhatIsSeenAndWhatIsHidden) {
    const Fixture f(halfPlane());
    ASSERT_GE(f.map.layout.levels, 2);
    for (int level = 0; level < f.map.layout.levels; ++level) {
        // Seen past the edge from the other side of the lens: hidden at the centre, 4 + 9 px deep.
        const vec4 edge = f.head(vec2(24, 24), level);
        EXPECT_NEAR(edge.x, -4, 1e-4) << level;
        EXPECT_NEAR(edge.y, 9, 1e-4) << level;
        EXPECT_EQ(edge.w, 2) << level;
        const vec4 front = f.layer(vec2(24, 24), level, 0), back = f.layer(vec2(24, 24), level, 1);
        EXPECT_NEAR(front.y, 0.5f, 1e-5) << level;
        EXPECT_NEAR(front.w, 1, 1e-5) << level;
        EXPECT_NEAR(back.x, 24, 2 << level);

        const vec4 open = f.head(vec2(52, 24), level);
        EXPECT_NEAR(open.x, 9, 1e-4) << level;
        EXPECT_EQ(open.y, kNoLayer) << level;
        EXPECT_EQ(open.w, 1) << level;
        EXPECT_EQ(f.layer(vec2(52, 24), level, 0).w, 1) << level;
        EXPECT_EQ(f.layer(vec2(52, 24), level, 1), vec4(0)) << level;
    }
}

TEST(LayerMap, coverageOfARimIsItsArea) {
    const Fixture f(halfPlane());
    double covered = 0; // the columns around the edge, 8 px wide
    for (float y = 8.25f; y < 40; y += 0.5f)
        for (float x = 28.25f; x < 36; x += 0.5f) {
            const vec4 head = f.head(vec2(x, y), 0);
            if (head.x < 0) covered += f.layer(vec2(x, y), 0, 0).w * 0.25;
        }
    EXPECT_NEAR(covered / 32, 4, 0.1);
}

TEST(Layers, clustersAreToldApartAndThoseInFocusAreNotServed) {
    const Fixture f(halfPlane());
    const LensBox lens{vec2(0.5f), vec2(0.7f)};
    const std::vector<Cluster> clusters = clustersOf(f.bins, f.allBricks, lens, 1, 20);
    ASSERT_EQ(clusters.size(), 2u);
    EXPECT_NEAR(clusters[0].slopeMin, -4, 1e-4);
    EXPECT_NEAR(clusters[0].slopeMax, -4, 1e-4);
    EXPECT_NEAR(clusters[1].slopeMin, 9, 1e-4);
    EXPECT_TRUE(clustersOf(f.bins, f.allBricks, lens, 1, 8).empty()) << "reaches further than the map";
    EXPECT_FALSE(clustersOf(f.bins, f.allBricks, {vec2(0), vec2(0.5f)}, 1, 8).empty());
    EXPECT_TRUE(clustersOf(f.bins, {}, lens, 1, 20).empty());

    std::vector<synthetic::Layer> focused = halfPlane();
    focused[0].slope = 0.3f;
    const Fixture g(focused);
    EXPECT_TRUE(clustersOf(g.bins, g.allBricks, lens, 1, 20).empty());
}

TEST(Layers, raysFindTheirSurfaces) {
    const Fixture f(halfPlane());
    const std::vector<Cluster> clusters = clustersOf(f.bins, f.allBricks, {vec2(-1), vec2(1)}, 1, 20);
    const auto look = [&](vec2 x, vec2 uv) {
        const vec4 point(uv, 0, 0);
        return throughLayers(f.map, clusters, x, {&point, 1}).value();
    };
    for (const float u : {-0.7f, -0.2f, 0.f, 0.4f, 0.8f})
        for (float x = 8.5f; x < 56; ++x) {
            const float front = x + 4 * u, back = x - 9 * u; // pinhole positions on either layer
            const vec3 rgb = look({x, 24.5f}, {u, 0.3f});
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
    const Cluster elsewhere{20, 21};
    const vec4 point(0.1f, 0.1f, 0, 0);
    EXPECT_FALSE(throughLayers(f.map, {&elsewhere, 1}, vec2(20, 20), {&point, 1}));
}

} // namespace
} // namespace slant

// Lookups in the layer map (lib/map_lookup.glsl) against closed forms on planes, and the classes of lists
// (lib/classify.glsl) against the slopes of all samples that they list.
#include "lib/map_texel.glsl"
#include "reconstruct/map_lookup.h"
#include "support/synthetic.h"

#include <cmath>
#include <functional>
#include <gtest/gtest.h>

namespace slant {
namespace {

constexpr double kRampPx = 80;

struct Draw {
    synthetic::Random random{37};

    double operator()(double low, double high) { return low + (high - low) * double(random.uniform()); }
    vec2 place(double low, double high) {
        const float x = float((*this)(low, high));
        return {x, float((*this)(low, high))};
    }
};

/// A layer over pinhole position.
struct Plane {
    std::function<float(vec2)> slope;
    std::function<vec3(vec2)> rgb;
    float coverage = 1;
    std::function<bool(vec2)> inside = [](vec2) { return true; };
};

/// A map of 128 x 96 pixels whose texels hold the values of planes, front to back, at the texels' centres.
LayerMap mapOf(const std::vector<Plane>& planes, int levels) {
    GridLayout grid{};
    grid.slopeMin = -20;
    grid.bucketCount = 40;
    grid.invBucket = 1;
    LayerMap map;
    map.layout.origin = {-32, -16};
    map.layout.size = {256, 192};
    map.layout.texelsPerPixel = 2;
    map.layout.levels = levels;
    map.layout.surfaceGap = 1;
    map.layout.code = slopeCode(grid);
    map.texels.resize(levelBegin(map.layout, levels));
    for (int level = 0; level < levels; ++level) {
        const ivec2 size = levelSize(map.layout, level);
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) {
                const vec2 middle =
                    vec2(map.layout.origin) + (vec2(x, y) + 0.5f) * (0.5f * float(1 << level));
                MapTexel texel;
                for (const Plane& plane : planes)
                    if (plane.inside(middle) && texel.count < kMapLayers)
                        texel.layers[std::size_t(texel.count++)] = {plane.rgb(middle), plane.coverage,
                                                                    plane.slope(middle)};
                map.texels[levelBegin(map.layout, level) + std::size_t(y) * std::size_t(size.x) +
                           std::size_t(x)] = packTexel(texel, map.layout.code);
            }
    }
    return map;
}

std::function<float(vec2)> always(float slope) {
    return [=](vec2) { return slope; };
}

/// Linear in pinhole position, so that it is what lies between texels as well: where rays look, from 0 to 1.
glm::dvec3 exactRamp(glm::dvec2 p) {
    return {(p.x + 10) / kRampPx, (p.y + 10) / kRampPx, 1 - (p.x + p.y + 20) / (2 * kRampPx)};
}
vec3 ramp(vec2 p) {
    return clamp(exactRamp(p), 0.0, 1.0);
}
double apart(glm::dvec3 a, glm::dvec3 b) {
    const glm::dvec3 off = abs(a - b);
    return std::max({off.x, off.y, off.z});
}
/// Packed colours, a half of 1/1024 each.
constexpr double kPacked = 0.001;

TEST(MapLookup, seesAPlaneAtThePinholePositionOfTheRay) {
    const float slope = 9;
    const LayerMap map = mapOf({{always(slope), ramp}}, 4);
    Draw draw;
    double shifted = 0;
    for (int i = 0; i < 4000; ++i) {
        const Cluster cluster = stillCluster(slope, slope, float(i % 4));
        const vec2 x = draw.place(4, 48), uv = draw.place(-1, 1);
        const std::optional<vec3> got = lookThrough(map, {&cluster, 1}, x, uv);
        ASSERT_TRUE(got);
        const glm::dvec2 p = glm::dvec2(x) - double(slope) * glm::dvec2(uv);
        ASSERT_LT(apart(glm::dvec3(*got), exactRamp(p)), kPacked) << i;
        shifted += apart(glm::dvec3(*got), exactRamp(p + 0.01 * glm::dvec2(uv) + 0.6)) > kPacked;
    }
    EXPECT_GT(shifted, 3500) << "a shift is noticed";
}

TEST(MapLookup, compositesTwoLayersFrontToBack) {
    const auto green = [](vec2) { return vec3(0, 1, 0); };
    const float coverage = 51 / 255.f;
    const LayerMap map = mapOf({{always(-4), green, coverage}, {always(9), ramp}}, 3);
    Draw draw;
    for (int i = 0; i < 4000; ++i) {
        const float level = float(i % 3);
        const std::vector<Cluster> clusters = {stillCluster(-4, -4, level), stillCluster(9, 9, level)};
        const vec2 x = draw.place(4, 48), uv = draw.place(-1, 1);
        const glm::dvec3 back = exactRamp(glm::dvec2(x) - 9.0 * glm::dvec2(uv));
        const std::optional<vec3> got = lookThrough(map, clusters, x, uv);
        ASSERT_TRUE(got);
        const double front = double(coverage);
        ASSERT_LT(apart(glm::dvec3(*got), front * glm::dvec3(0, 1, 0) + (1 - front) * back), kPacked) << i;
        const std::optional<vec3> alone = lookThrough(map, {clusters.data(), 1}, x, uv);
        ASSERT_LT(apart(glm::dvec3(*alone), glm::dvec3(0, 1, 0)), kPacked)
            << "the last one fills what is left";
    }
}

/// What a tile sees from -4 to 9 without gaps is one cluster, however far apart the two layers of a texel
/// are.
TEST(MapLookup, seesBothLayersOfOneCluster) {
    const auto green = [](vec2) { return vec3(0, 1, 0); };
    const float coverage = 51 / 255.f;
    const LayerMap map = mapOf({{always(-4), green, coverage}, {always(9), ramp}}, 3);
    Draw draw;
    for (int i = 0; i < 4000; ++i) {
        const float level = float(i % 3);
        const std::vector<Cluster> apart{stillCluster(-4, -4, level), stillCluster(9, 9, level)};
        const Cluster together = stillCluster(-4, 9, level);
        const vec2 x = draw.place(4, 48), uv = draw.place(-1, 1);
        const std::optional<vec3> expected = lookThrough(map, apart, x, uv);
        const std::optional<vec3> got = lookThrough(map, {&together, 1}, x, uv);
        ASSERT_TRUE(expected && got);
        ASSERT_EQ(*got, *expected) << i;
    }
}

/// Past its edge, a layer ends over the width of a texel.
TEST(MapLookup, edgesAreAsWideAsATexel) {
    const auto green = [](vec2) { return vec3(0, 1, 0); };
    const auto left = [](vec2 p) { return p.x < 20; };
    const LayerMap map = mapOf({{always(-4), green, 1, left}, {always(9), ramp}}, 3);
    Draw draw;
    int partly = 0;
    for (int i = 0; i < 8000; ++i) {
        const int level = i % 3;
        const std::vector<Cluster> clusters = {stillCluster(-4, -4, float(level)),
                                               stillCluster(9, 9, float(level))};
        const vec2 x = draw.place(4, 48), uv = draw.place(-1, 1);
        const glm::dvec3 back = exactRamp(glm::dvec2(x) - 9.0 * glm::dvec2(uv));
        const double beyond = (double(x.x) + 4 * double(uv.x) - 20) * 2 / (1 << level); // texels
        const double front = std::clamp(0.5 - beyond, 0.0, 1.0);
        const glm::dvec3 expected = front * glm::dvec3(0, 1, 0) + (1 - front) * back;
        // Surfaces that would show through by less than kOpaque are not looked up.
        ASSERT_LT(apart(glm::dvec3(*lookThrough(map, clusters, x, uv)), expected), kPacked + double(kOpaque))
            << i;
        partly += front > 0.01 && front < 0.99;
    }
    EXPECT_GT(partly, 50);
}

/// A surface of slope a + b x, where a ray through u meets it at (x - a u) / (1 + b u). A few steps come as
/// close as texels allow.
TEST(MapLookup, settlesWhereASlantedSurfaceHasTheSlopeOfTheRay) {
    const double a = -2, b = 0.06;
    const LayerMap map = mapOf({{[=](vec2 p) { return float(a + b * double(p.x)); }, ramp}}, 1);
    Draw draw;
    double worst = 0, worstUnsettled = 0;
    for (int i = 0; i < 4000; ++i) {
        const vec2 x = draw.place(10, 40), uv = draw.place(-1, 1);
        const Cluster cluster = stillCluster(float(a - 32 * b), float(a + 96 * b), 0);
        const double px = (double(x.x) - a * double(uv.x)) / (1 + b * double(uv.x));
        const double slope = a + b * px;
        const glm::dvec2 p(px, double(x.y) - slope * double(uv.y));
        const std::optional<vec3> got = lookThrough(map, {&cluster, 1}, x, uv);
        ASSERT_TRUE(got);
        worst = std::max(worst, apart(glm::dvec3(*got), exactRamp(p)) * kRampPx);
        const glm::dvec2 unsettled = glm::dvec2(x) - (a + 32 * b) * glm::dvec2(uv);
        worstUnsettled = std::max(worstUnsettled, apart(exactRamp(unsettled), exactRamp(p)) * kRampPx);
    }
    EXPECT_LT(worst, 0.3) << "pixels, some of them from packing";
    EXPECT_GT(worstUnsettled, 1);
}

/// What lib/classify.glsl should find, from the slopes of all listed samples.
struct Classified {
    std::vector<Cluster> clusters;
    bool served = true, inFocus = false, sparse = true;
};

Classified classified(const Bins& bins, std::span<const uint> bricks, const LensBox& lens,
                      const MapLayout& map) {
    const std::size_t cells = std::size_t(bins.grid.cellsPerBrick) * std::size_t(bins.grid.cellsPerBrick);
    std::vector<double> slopes;
    double finest = 1;
    for (const uint brick : bricks) {
        double widest = 0;
        for (uint record = bins.cellStart[brick * cells]; record < bins.cellStart[(brick + 1) * cells];
             ++record) {
            slopes.push_back(double(bins.positions[record].z));
            widest = std::max(widest, 1 / double(bins.values[record].w));
        }
        finest = std::min(finest, widest);
    }
    std::sort(slopes.begin(), slopes.end());
    const glm::dvec2 far = max(abs(glm::dvec2(lens.min)), abs(glm::dvec2(lens.max)));
    const double lensRadius = std::min(glm::length(far), 1.0);
    const glm::dvec2 size = glm::dvec2(lens.max) - glm::dvec2(lens.min);
    Classified found;
    for (std::size_t begin = 0, end = 0; begin < slopes.size(); begin = end) {
        for (end = begin + 1; end < slopes.size() && slopes[end] <= slopes[end - 1] + double(map.surfaceGap);)
            ++end;
        const double low = slopes[begin], high = slopes[end - 1];
        const double least = low > 0    ? low
                             : high < 0 ? -high
                                        : 0,
                     most = std::max(std::abs(low), std::abs(high));
        const double spacing = map.texelsPerPixel * double(map.spreadPerPx) * least;
        const int halvings =
            spacing < double(kLevelSpacing) ? 0 : 1 + int(std::log2(spacing / double(kLevelSpacing)));
        found.clusters.push_back(
            stillCluster(float(low), float(high), float(std::min(halvings, map.levels - 1))));
        found.inFocus |= least < double(kMinSlope);
        found.sparse &= most * std::max(size.x, size.y) <= double(kSparsePx);
        found.served &= most * lensRadius <= double(map.reachPx);
        found.served &= (high - low) * lensRadius <= double(kWidestClusterPx);
    }
    const bool tooCoarse = finest * double(map.radiusPx) * map.texelsPerPixel < 1;
    found.served &= !found.clusters.empty() && found.clusters.size() <= kMaxClusters;
    found.served &= !(found.inFocus && (tooCoarse || found.clusters.size() > kMaxInFocusClusters));
    return found;
}

/// Slopes 2 apart, up to half the picture's width: larger ones share the last bucket.
std::vector<synthetic::Layer> staircase(int steps) {
    std::vector<synthetic::Layer> layers;
    for (int k = 0; k < steps; ++k)
        layers.push_back({float(2 * k - 9) + 0.7f,
                          [=](vec2 p) { return k + 1 == steps || int(std::floor(p.x)) % steps == k; },
                          [](vec2) { return vec3(1); }});
    return layers;
}

TEST(Classify, clustersAreThoseOfAllListedSamples) {
    const Rect frame{0, 0, 64, 48};
    const std::vector<synthetic::Layer> nearFocus = {
        {2, [](vec2) { return true; }, [](vec2) { return vec3(1); }}};
    int served = 0, unserved = 0, inFocus = 0, sparse = 0, higher = 0, lists = 0;
    for (const int spp : {1, 4, 9})
        for (const auto& layers : {synthetic::discsOverChecks(), nearFocus, staircase(4), staircase(20)}) {
            const LightField field = synthetic::sample(layers, frame, 15, spp, 3);
            const Bins bins = binSamples(SceneSideSamples(field), {frame});
            MapLayout map =
                chooseMap(bins.grid, {}, frame, mapTexelsPerPixel(field), mapReach(bins.grid, {}, 1), 0.5f);
            map.reachPx = min(map.reachPx, 30.f);
            const OutputPattern pattern = makeOutputPattern(512, 14);
            OutputLayout tiles{};
            tiles.regionSize = {frame.width(), frame.height()};
            tiles.tileCount = tiles.regionSize / kTileSize;
            const TileLists all = makeTileLists(bins, tiles, pattern.groups, bins.grid.radiusPx);
            const std::size_t perGroup = std::size_t(tiles.tileCount.x) * std::size_t(tiles.tileCount.y);
            for (std::size_t list = 0; list + 1 < all.start.size(); list += 7) {
                const std::span<const uint> bricks(all.bricks.data() + all.start[list],
                                                   all.start[list + 1] - all.start[list]);
                const LensBox& lens = pattern.groups[list / perGroup];
                const ListClass got = classOfList(bins, bricks, sightThrough(lens, 1), vec2(0), map);
                const Classified expected = classified(bins, bricks, lens, map);
                ++lists;
                ASSERT_EQ(!got.clusters.empty(), expected.served) << list;
                ASSERT_EQ(got.sparse, expected.sparse) << list;
                sparse += got.sparse;
                if (!expected.served) {
                    ++unserved;
                    continue;
                }
                ++served;
                inFocus += got.inFocus;
                ASSERT_EQ(got.inFocus, expected.inFocus) << list;
                ASSERT_EQ(got.clusters.size(), expected.clusters.size()) << list;
                for (std::size_t k = 0; k < got.clusters.size(); ++k) {
                    ASSERT_EQ(got.clusters[k].slopeMin, expected.clusters[k].slopeMin);
                    ASSERT_EQ(got.clusters[k].slopeMax, expected.clusters[k].slopeMax);
                    ASSERT_EQ(got.clusters[k].level, expected.clusters[k].level);
                    higher += got.clusters[k].level > 0;
                }
            }
        }
    EXPECT_GT(served, 1000);
    EXPECT_GT(unserved, 100);
    EXPECT_GT(inFocus, 100);
    EXPECT_GT(sparse, 100);
    EXPECT_GT(higher, 100);
    EXPECT_GT(lists - sparse, 100);
}

} // namespace
} // namespace slant

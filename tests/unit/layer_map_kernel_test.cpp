// The layer map's texels (lib/map_texel.glsl, map_sweep.glsl, map_reduce.glsl) against all samples of a field
// and means in double precision.
#include "lib/map_reduce.glsl"
#include "reconstruct/layer_map.h"
#include "support/brute_force.h"
#include "support/synthetic.h"

#include <gtest/gtest.h>

namespace slant {
namespace {

const Rect kFrame{0, 0, 44, 36};

struct Draw {
    synthetic::Random random{31};

    double operator()(double low, double high) { return low + (high - low) * double(random.uniform()); }
};

/// A layer in double precision.
struct Layer {
    glm::dvec3 rgb;
    double coverage, slope;
};

double largest(glm::dvec3 rgb) {
    return std::max({rgb.x, rgb.y, rgb.z});
}

/// Whether a packed layer is this one, by the bounds that lib/map_texel.glsl states and the rounding of the
/// numbers that were packed.
bool isPacked(const MapLayer& got, const Layer& expected, const SlopeCode& code, double rounding) {
    const double most = largest(expected.rgb), least = 0x1p-126;
    const glm::dvec3 off = abs(glm::dvec3(got.rgb) - expected.rgb);
    const double slopeRounding = 3e-7 * std::max(std::abs(expected.slope), std::abs(double(code.least)));
    return std::max(off.x, off.y) <= most / 2048 + rounding * most + least &&
           off.z <= most / 1024 + rounding * most + 2 * least &&
           std::abs(double(got.coverage) - std::max(expected.coverage, 1.0 / 255)) <=
               0.501 / 255 + rounding &&
           std::abs(double(got.slope) - expected.slope) <=
               0.51 * double(code.step) + slopeRounding + rounding;
}

SlopeCode someCode() {
    GridLayout grid{};
    grid.slopeMin = -40;
    grid.bucketCount = 150;
    grid.invBucket = 1.5f;
    return slopeCode(grid);
}

TEST(MapTexelWords, areOffByNoMoreThanTheyState) {
    const SlopeCode code = someCode();
    Draw draw;
    double worst = 0, worstBlue = 0, worstSlope = 0;
    for (int i = 0; i < 200000; ++i) {
        const double bright = std::exp2(draw(-115, 127));
        const vec3 rgb =
            vec3(float(bright * draw(0, 1)), float(bright * draw(0, 1)), float(bright * draw(0, 1)));
        const float coverage = float(draw(0, 1)), slope = float(draw(-40, 60));
        MapTexel texel;
        texel.count = 1;
        texel.layers[0] = {rgb, coverage, slope};
        const MapTexel back = unpackTexel(packTexel(texel, code), code);
        ASSERT_EQ(back.count, 1);
        const MapLayer& got = back.layers[0];
        ASSERT_TRUE(isPacked(got, {glm::dvec3(rgb), double(coverage), double(slope)}, code, 0))
            << rgb.x << ' ' << rgb.y << ' ' << rgb.z << ", " << coverage << ", " << slope;
        const glm::dvec3 off = abs(glm::dvec3(got.rgb) - glm::dvec3(rgb)) / largest(rgb);
        worst = std::max({worst, off.x, off.y});
        worstBlue = std::max(worstBlue, off.z);
        worstSlope = std::max(worstSlope, std::abs(double(got.slope) - double(slope)) / double(code.step));
    }
    EXPECT_GT(worst, 0.9 / 2048) << "the bounds are met";
    EXPECT_GT(worstBlue, 0.9 / 1024);
    EXPECT_GT(worstSlope, 0.49);
}

TEST(MapTexelWords, keepWhatIsExact) {
    const SlopeCode code = someCode();
    for (int exponent = -116; exponent <= 117; ++exponent) {
        const float unit = std::exp2(float(exponent));
        MapTexel texel;
        texel.count = 2;
        texel.layers[0] = {unit * vec3(1024, 1025, 2), 1, code.least};
        texel.layers[1] = {unit * vec3(2047, 0, 2046), 51 / 255.f, code.least + 65534 * code.step};
        const MapTexel back = unpackTexel(packTexel(texel, code), code);
        ASSERT_EQ(back.count, 2);
        for (int layer = 0; layer < 2; ++layer) {
            ASSERT_EQ(back.layers[std::size_t(layer)].rgb, texel.layers[std::size_t(layer)].rgb) << exponent;
            ASSERT_FLOAT_EQ(back.layers[std::size_t(layer)].coverage,
                            texel.layers[std::size_t(layer)].coverage);
            ASSERT_EQ(back.layers[std::size_t(layer)].slope, texel.layers[std::size_t(layer)].slope);
        }
    }
}

TEST(MapTexelWords, slopesBeyondTheGridAreItsEnds) {
    const SlopeCode code = someCode();
    for (const float slope : {-1e9f, -41.f, 61.f, 1e9f}) {
        MapTexel texel;
        texel.layers[0] = {vec3(1), 1, slope};
        const MapTexel back = unpackTexel(packTexel(texel, code), code);
        ASSERT_EQ(back.count, 1);
        EXPECT_NEAR(back.layers[0].slope, slope < 0 ? -40 : 60, code.step);
    }
}

/// Children of a texel: up to two layers each, near a few slopes.
std::vector<MapTexel> someChildren(Draw& draw) {
    std::vector<MapTexel> children(4);
    for (MapTexel& child : children) {
        child.count = int(draw(0, 2.999));
        std::vector<double> slopes;
        for (int k = 0; k < child.count; ++k) slopes.push_back(draw(0, 1) < 0.5 ? draw(-3, 3) : draw(10, 12));
        std::sort(slopes.begin(), slopes.end());
        for (int k = 0; k < child.count; ++k)
            child.layers[std::size_t(k)] = {vec3(float(draw(0, 1)), float(draw(0, 1)), float(draw(0, 1))),
                                            float(draw(0.01, 1)), float(slopes[std::size_t(k)])};
    }
    return children;
}

/// What is left of four texels: their layers, split at gaps, each a mean weighted by coverage.
std::vector<Layer> meanOf(std::vector<MapLayer> layers, double gap) {
    std::sort(layers.begin(), layers.end(),
              [](const MapLayer& a, const MapLayer& b) { return a.slope < b.slope; });
    std::vector<Layer> means;
    double end = -1e9;
    for (const MapLayer& layer : layers) {
        if (double(layer.slope) > end + gap) means.push_back({});
        end = double(layer.slope);
        means.back().rgb += double(layer.coverage) * glm::dvec3(layer.rgb);
        means.back().slope += double(layer.coverage) * double(layer.slope);
        means.back().coverage += double(layer.coverage);
    }
    for (Layer& mean : means) {
        mean.rgb /= mean.coverage;
        mean.slope /= mean.coverage;
        mean.coverage = std::min(mean.coverage / 4, 1.0);
    }
    means.resize(std::min<std::size_t>(means.size(), kMapLayers));
    return means;
}

TEST(MapReduce, isTheMeanOfFourTexels) {
    const SlopeCode code = someCode();
    Draw draw;
    int empty = 0, two = 0;
    for (int i = 0; i < 20000; ++i) {
        const float gap = float(draw(0.1, 2));
        Children children;
        std::vector<MapLayer> layers;
        const std::vector<MapTexel> texels = someChildren(draw);
        for (int k = 0; k < 4; ++k) {
            const glm::uvec4 words = packTexel(texels[std::size_t(k)], code);
            setChild(children, k, words, code);
            const MapTexel packed = unpackTexel(words, code);
            for (int n = 0; n < packed.count; ++n) layers.push_back(packed.layers[std::size_t(n)]);
        }
        const MapTexel got = unpackTexel(reduced(children, gap, code), code);
        const std::vector<Layer> expected = meanOf(layers, double(gap));
        ASSERT_EQ(got.count, int(expected.size())) << i;
        for (int k = 0; k < got.count; ++k)
            ASSERT_TRUE(isPacked(got.layers[std::size_t(k)], expected[std::size_t(k)], code, 1e-5)) << i;
        empty += got.count == 0;
        two += got.count == 2;
    }
    EXPECT_GT(empty, 50);
    EXPECT_GT(two, 5000);
}

/// The layers around a place by all samples.
std::vector<Layer> layersAround(const test::BruteForce& truth, const MapLayout& map, vec2 place) {
    Output o{};
    o.xy = place;
    const double tent = double(map.tentPx), most = tent * map.texelsPerPixel;
    std::vector<Layer> layers;
    for (const double searched : {tent, 2 * tent}) {
        if (searched > tent && layers.size() < 2) break; // a single surface needs no more
        layers.clear();
        const auto surfaces = truth.surfaces(o, searched, most);
        for (test::BruteForce::Surface surface : surfaces) {
            for (auto& s : surface) // more samples than the tent takes
                s.sample.weight *= std::pow(std::min(s.sample.radiusRatio, most) / s.sample.radiusRatio, 2);
            const auto shares = test::BruteForce::shares(surface, tent);
            if (!(shares.inner > 0) || layers.size() == kMapLayers) continue;
            const bool alone =
                layers.empty() && surface.back().sample.slope == surfaces.back().back().sample.slope;
            const double full = truth.fullWeight(tent);
            const double coverage =
                alone || truth.isSolid(surface, tent) ? 1 : std::min(shares.inner / full, 1.0);
            layers.push_back({shares.innerRgb / shares.inner, coverage, shares.slope / shares.inner});
        }
    }
    return layers;
}

struct MapDifferences {
    int different = 0, two = 0;
};

MapDifferences differences(const LayerMap& map, const test::BruteForce& truth, int count) {
    Draw draw;
    MapDifferences found;
    for (int i = 0; i < count; ++i) {
        const ivec2 texel(draw(0, map.layout.size.x), draw(0, map.layout.size.y));
        const MapTexel got = unpackTexel(
            map.texels[std::size_t(texel.y) * std::size_t(map.layout.size.x) + std::size_t(texel.x)],
            map.layout.code);
        const std::vector<Layer> expected = layersAround(truth, map.layout, texelCenter(map.layout, texel));
        bool same = got.count == int(expected.size());
        for (int k = 0; same && k < got.count; ++k)
            same = isPacked(got.layers[std::size_t(k)], expected[std::size_t(k)], map.layout.code, 2e-5);
        found.different += !same;
        found.two += expected.size() == 2;
    }
    return found;
}

struct Made {
    LightField field;
    Bins bins;
    LayerMap map;

    explicit Made(LightField made) : field(std::move(made)) {
        const SceneSideSamples samples(field);
        bins = binSamples(samples, {kFrame});
        takeValues(bins, samples, ValuePlane::radiance);
        map = makeLayerMap(bins, chooseMap(bins.grid, {}, kFrame, mapTexelsPerPixel(field),
                                           mapReach(bins.grid, {}, 1), 0.5f));
    }
};

/// Without the samples that no output of the frame can see: the map reaches farther.
test::BruteForce truthOf(const Made& made) {
    test::BruteForce truth(made.field, made.bins);
    std::erase_if(truth.samples, [](const auto& s) { return !s.binned; });
    return truth;
}

TEST(MapSweep, texelsHaveTheSurfacesOfBruteForce) {
    std::vector<LightField> fields;
    for (const int spp : {1, 2, 4, 16})
        fields.push_back(synthetic::sample(synthetic::discsOverChecks(), kFrame, 15, spp, 3));
    for (const synthetic::Counts& counts : synthetic::varyingCounts(kFrame))
        fields.push_back(synthetic::sample(synthetic::discsOverChecks(), kFrame, 15, counts.at, 3));
    for (LightField& field : fields) {
        const Made made(std::move(field));
        const test::BruteForce truth = truthOf(made);
        const MapDifferences found = differences(made.map, truth, 250);
        EXPECT_EQ(found.different, 0) << made.field.samplesPerPixel;
        EXPECT_GT(found.two, 10);
    }
}

TEST(MapSweep, bruteForceNoticesWhatIsWrong) {
    const Made made(synthetic::sample(synthetic::discsOverChecks(), kFrame, 15, 4, 3));
    test::BruteForce moved = truthOf(made), fewer = moved, unweighted = moved;
    for (auto& s : moved.samples) s.slope += 0.02;
    EXPECT_GT(differences(made.map, moved, 250).different, 100);
    std::erase_if(fewer.samples, [i = 0](const auto&) mutable { return ++i % 5 == 0; });
    EXPECT_GT(differences(made.map, fewer, 250).different, 20);
    for (auto& s : unweighted.samples) s.weight = 1;
    EXPECT_GT(differences(made.map, unweighted, 250).different, 10);
}

} // namespace
} // namespace slant

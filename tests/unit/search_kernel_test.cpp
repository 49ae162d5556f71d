// The search of the bins (lib/search.glsl, nearest.glsl, visibility.glsl, surface.glsl) against all samples
// of a field in double precision.
//
// Bricks come front to back, samples of one bucket of slopes in any order. So if the slopes of one surface
// spread by less than a bucket, and surfaces are more than two buckets apart, splitting them in the order of
// bricks is splitting them in the order of slopes, and the kernels must give what their description says.
// Elsewhere a few outputs may differ.
#include "reconstruct/search.h"
#include "support/brute_force.h"
#include "support/synthetic.h"

#include <gtest/gtest.h>

namespace slant {
namespace {

const Rect kFrame{0, 0, 44, 36};
constexpr int kOverscan = 15;
constexpr int kOutputs = 400;
/// Of values up to 1; measured below 3e-6 where nothing is decided by rounding.
constexpr double kTolerance = 5e-5;

/// Slopes of the samples differ by up to `spread` from those of their layers.
LightField scattered(LightField field, float spread) {
    synthetic::Random random(11);
    for (LightFieldSample& s : field.samples) s.slope += spread * (random.uniform() - 0.5f);
    return field;
}

LightField uniformField(int spp) {
    return synthetic::sample(synthetic::discsOverChecks(), kFrame, kOverscan, spp, 3);
}

Bins binsOf(const LightField& field) {
    const SceneSideSamples samples(field);
    Bins bins = binSamples(samples, {kFrame});
    takeValues(bins, samples, ValuePlane::radiance);
    return bins;
}

/// Outputs anywhere in the frame, with the lists that they are given.
class Lists {
public:
    Lists(const Bins& bins, float marginPx) : bins_(bins), pattern_(makeOutputPattern(64, 12)) {
        layout_.regionOrigin = ivec2(kFrame.x0, kFrame.y0);
        layout_.regionSize = ivec2(kFrame.width(), kFrame.height());
        layout_.tileCount = (layout_.regionSize + kTileSize - 1) / kTileSize;
        lists_ = makeTileLists(bins, layout_, pattern_.groups, marginPx);
    }

    /// visit(output, context)
    void forEachOutput(int count, const auto& visit) const {
        synthetic::Random random(23);
        for (int i = 0; i < count; ++i) {
            const ivec2 pixel(random.uniform() * float(kFrame.width()),
                              random.uniform() * float(kFrame.height()));
            const int index = int(random.bits() % 64);
            const ivec2 tile = pixel / kTileSize;
            const std::size_t list =
                std::size_t(index / pattern_.groupSize() * layout_.tileCount.y + tile.y) *
                    std::size_t(layout_.tileCount.x) +
                std::size_t(tile.x);
            const uint begin = lists_.start[list], end = lists_.start[list + 1];
            const SearchContext context{bins_, std::span(lists_.bricks).subspan(begin, end - begin)};
            visit(outputAt(pixel, index, pattern_, 9), context);
        }
    }

private:
    const Bins& bins_;
    OutputPattern pattern_;
    OutputLayout layout_{};
    TileLists lists_;
};

struct Differences {
    int outputs = 0, different = 0;
    int parted = 0;              ///< several surfaces, or none
    double worst = 0, drift = 0; ///< greatest difference, sum of signed ones

    void add(const std::optional<glm::dvec3>& expected, const std::optional<vec3>& got) {
        ++outputs;
        parted += !expected;
        if (expected.has_value() != got.has_value()) {
            ++different;
            worst = 1;
        } else if (expected) {
            const glm::dvec3 apart = glm::abs(*expected - glm::dvec3(*got));
            const double most = std::max({apart.x, apart.y, apart.z});
            different += !(most <= kTolerance);
            worst = std::max(worst, most);
            drift += glm::dot(glm::dvec3(*got) - *expected, glm::dvec3(1.0 / 3));
        }
    }
};

std::optional<vec3> resolved(const Reconstructed& result) {
    return result.outcome == Outcome::resolved ? std::optional(result.rgb) : std::nullopt;
}

Differences nearestOf(const Bins& bins, const test::BruteForce& truth, int outputs = kOutputs) {
    Differences found;
    const Lists lists(bins, bins.grid.radiusPx);
    lists.forEachOutput(outputs, [&](const Output& o, const SearchContext& context) {
        found.add(truth.nearest(o), resolved(reconstructNearest(context, o)));
    });
    return found;
}

Differences visibleOf(const Bins& bins, const test::BruteForce& truth, float widening = 1,
                      int outputs = kOutputs) {
    Differences found;
    const float base = widening * bins.grid.radiusPx;
    const Lists lists(bins, 2 * base);
    lists.forEachOutput(outputs, [&](const Output& o, const SearchContext& context) {
        found.add(truth.visible(o, base), resolved(resolveVisibility(context, o, base)));
    });
    return found;
}

struct Named {
    std::string name;
    LightField field;
};

/// Surfaces before, at and behind the focus whose slopes spread by 0 or by half a bucket.
std::vector<Named> clearFields() {
    std::vector<Named> fields;
    for (const int spp : {1, 4, 16}) {
        fields.push_back({std::to_string(spp) + " spp", uniformField(spp)});
        const float bucket = binsOf(fields.back().field).grid.surfaceGap;
        fields.push_back(
            {fields.back().name + ", spread slopes", scattered(fields.back().field, bucket / 2)});
    }
    for (const synthetic::Counts& counts : synthetic::varyingCounts(kFrame))
        fields.push_back(
            {counts.name, synthetic::sample(synthetic::discsOverChecks(), kFrame, kOverscan, counts.at, 3)});
    return fields;
}

TEST(Search, nearestSurfaceIsThatOfBruteForce) {
    for (const auto& [name, field] : clearFields()) {
        const Bins bins = binsOf(field);
        const Differences found = nearestOf(bins, {field, bins});
        EXPECT_EQ(found.different, 0) << name << ", worst " << found.worst;
        EXPECT_GT(found.parted, found.outputs / 50) << name;
        EXPECT_LT(found.parted, found.outputs * 9 / 10) << name;
    }
}

TEST(Search, visibleSurfacesAreThoseOfBruteForce) {
    for (const auto& [name, field] : clearFields()) {
        const Bins bins = binsOf(field);
        const Differences found = visibleOf(bins, {field, bins});
        EXPECT_EQ(found.different, 0) << name << ", worst " << found.worst;
    }
}

TEST(Search, widerSearchesAreThoseOfBruteForce) {
    const LightField field = uniformField(4);
    const Bins bins = binsOf(field);
    const test::BruteForce truth(field, bins);
    for (const float widening : {2.f, 4.f, 8.f}) {
        const Differences found = visibleOf(bins, truth, widening, 150);
        EXPECT_EQ(found.different, 0) << widening << ", worst " << found.worst;
        EXPECT_EQ(found.parted, 0) << "nothing is left to find";
    }
}

/// Half of the picture has no samples: outputs there find samples across the border, or nothing.
TEST(Search, findsNothingWhereBruteForceDoesNot) {
    const LightField field = synthetic::sample(
        {{0.1f, [](vec2) { return true; }, [](vec2 p) { return vec3(0.5f + 0.4f * std::sin(p.x)); }}}, kFrame,
        kOverscan, [](int x, int) { return x < 20 ? 0 : 4; }, 3);
    const Bins bins = binsOf(field);
    const test::BruteForce truth(field, bins);
    for (const float widening : {1.f, 8.f}) {
        const Differences found = visibleOf(bins, truth, widening);
        EXPECT_EQ(found.different, 0) << widening;
        EXPECT_GT(found.parted, widening == 1 ? found.outputs / 4 : -1) << widening;
        EXPECT_LT(found.parted, found.outputs * 3 / 4) << widening;
    }
}

/// Through a lens map distances are those on the film.
TEST(Search, measuresDistancesInTheMetricOfTheFilm) {
    const LightField field = uniformField(4);
    const Bins bins = binsOf(field);
    const test::BruteForce truth(field, bins);
    const Lists lists(bins, 4 * bins.grid.radiusPx);
    Differences found;
    lists.forEachOutput(kOutputs, [&](Output o, const SearchContext& context) {
        o.onSceneSide = true;
        o.filmMetric = vec3(0.8f, 0.15f, 1.3f);
        // Half the sides of the box around what the metric makes a unit circle: rows of its inverse.
        const float det = 0.8f * 1.3f - 0.15f * 0.15f;
        o.extent = vec2(std::hypot(1.3f, 0.15f), std::hypot(0.8f, 0.15f)) / det;
        found.add(truth.visible(o, bins.grid.radiusPx),
                  resolved(resolveVisibility(context, o, bins.grid.radiusPx)));
    });
    EXPECT_EQ(found.different, 0) << found.worst;
}

/// Slopes of the samples rise with their pinhole positions, by `perPx` along x.
LightField tilted(LightField field, float perPx) {
    for (LightFieldSample& s : field.samples) s.slope += perPx * (s.x - s.slope * s.u - 22);
    return field;
}

TEST(Search, slantedSurfacesAreThoseOfBruteForce) {
    for (const int spp : {1, 4, 16}) {
        const LightField field = tilted(uniformField(spp), 0.1f);
        const Bins bins = binsOf(field);
        const test::BruteForce truth(field, bins);
        EXPECT_EQ(nearestOf(bins, truth).different, 0) << spp;
        EXPECT_EQ(visibleOf(bins, truth).different, 0) << spp;
    }
}

/// Measured: at most 16 % and 33 % of the outputs, and 0.002 on average.
TEST(Search, differsInSomeOutputsButNotOnAverageWhereSurfacesRunTogether) {
    for (const int spp : {1, 4, 16})
        for (const LightField& field : {tilted(uniformField(spp), 0.3f), scattered(uniformField(spp), 3)}) {
            const Bins bins = binsOf(field);
            const test::BruteForce truth(field, bins);
            const Differences nearest = nearestOf(bins, truth), visible = visibleOf(bins, truth);
            EXPECT_LE(nearest.different, kOutputs / 5) << spp;
            EXPECT_LE(visible.different, kOutputs * 2 / 5) << spp;
            EXPECT_LT(std::abs(nearest.drift), 0.004 * kOutputs) << spp;
            EXPECT_LT(std::abs(visible.drift), 0.004 * kOutputs) << spp;
        }
}

TEST(Search, bruteForceNoticesWhatIsWrong) {
    const LightField field = uniformField(4);
    const Bins bins = binsOf(field);
    const test::BruteForce truth(field, bins);
    EXPECT_TRUE(std::ranges::all_of(truth.samples, [](const auto& s) {
        return s.binned || s.xy.x < -5 || s.xy.y < -5 || s.xy.x > 49 || s.xy.y > 41;
    }));

    test::BruteForce moved = truth; // slopes 1 % greater
    for (auto& s : moved.samples) s.slope *= 1.01;
    EXPECT_GT(visibleOf(bins, moved).different, kOutputs / 2);

    test::BruteForce fewer = truth; // without one sample in a hundred
    std::erase_if(fewer.samples, [i = 0](const auto&) mutable { return ++i % 100 == 0; });
    EXPECT_GT(nearestOf(bins, fewer).different, kOutputs / 50);
    EXPECT_GT(visibleOf(bins, fewer).different, kOutputs / 50);

    test::BruteForce unweighted = truth;
    for (auto& s : unweighted.samples) s.weight = 1;
    EXPECT_GT(visibleOf(bins, unweighted).different, kOutputs / 20);

    test::BruteForce merged = truth; // surfaces are merged
    merged.gap = 100;
    EXPECT_GT(nearestOf(bins, merged).different, kOutputs / 50);
    EXPECT_GT(visibleOf(bins, merged).different, kOutputs / 20);

    test::BruteForce wider = truth;
    wider.radius *= 1.02;
    EXPECT_GT(nearestOf(bins, wider).different, kOutputs / 4);
}

/// The tent's volume over samples of density kSearchRadius^2 / R^2.
TEST(Search, fullWeightIsTheVolumeOfTheTent) {
    EXPECT_NEAR(kFullWeight, std::numbers::pi / 3 * double(kSearchRadius) * double(kSearchRadius), 3e-5);
    const LightField field = uniformField(16);
    const Bins bins = binsOf(field);
    const test::BruteForce truth(field, bins);
    EXPECT_NEAR(truth.fullWeight(bins.grid.radiusPx), kFullWeight, 3e-5);
    // In the middle of the plane behind, what the samples of a surface add up to.
    double inner = 0, outer = 0;
    int count = 0;
    synthetic::Random random(5);
    for (int i = 0; i < 1500; ++i) {
        const vec2 xy(8 + 28 * random.uniform(), 8 + 20 * random.uniform());
        Output o{};
        o.xy = xy;
        const auto surfaces = truth.surfaces(o, 2 * truth.radius);
        if (surfaces.size() != 1 || surfaces[0][0].sample.slope != 9) continue;
        const auto shares = test::BruteForce::shares(surfaces[0], truth.radius);
        inner += shares.inner, outer += shares.outer, ++count;
    }
    ASSERT_GT(count, 200);
    EXPECT_NEAR(inner / count / kFullWeight, 1, 0.1);
    EXPECT_NEAR(outer / count / (8 * kFullWeight), 1, 0.1);
}

} // namespace
} // namespace slant

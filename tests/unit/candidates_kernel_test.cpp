// Which samples lib/search.glsl visits, and in which order, against all samples of a field in double
// precision.
#include "reconstruct/candidates.h"
#include "reconstruct/kernels.h"
#include "support/brute_force.h"
#include "support/synthetic.h"

#include <gtest/gtest.h>
#include <limits>
#include <map>
#include <numeric>

namespace slant {
namespace {

const Rect kFrame{0, 0, 44, 36};

/// A sweep that keeps all candidates. Colours identify samples.
struct KeepingKernels {
    static constexpr bool kMoving = false;
#include "reconstruct/bin_fetches.h"

    struct Sweep {
        bool running = true;
        std::size_t most = 1u << 30;
        std::vector<Candidate> visited;
    };
    static void visit(const Candidate& candidate, Sweep& sweep) {
        sweep.visited.push_back(candidate);
        sweep.running = sweep.visited.size() < sweep.most;
    }
    static bool hides(const Sweep&, const Brick&) {
        return false;
    }
#include "lib/search.glsl"
};

struct Field {
    LightField field;
    Bins bins;
    std::vector<uint> allBricks;

    explicit Field(LightField made) : field(std::move(made)) {
        for (std::size_t i = 0; i < field.samples.size(); ++i) field.radiance[i] = vec3(float(i), 0, 0);
        const SceneSideSamples samples(field);
        bins = binSamples(samples, {kFrame});
        takeValues(bins, samples, ValuePlane::radiance);
        allBricks.resize(bins.bricks.size());
        std::iota(allBricks.begin(), allBricks.end(), 0u);
    }

    KeepingKernels::Sweep visited(const Output& o, float radius, float maxRatio = kAnyRadiusRatio) const {
        const SearchContext context{bins, allBricks};
        KeepingKernels kernels{context};
        KeepingKernels::Sweep sweep;
        kernels.forEachCandidate(bins.grid, o, radius, maxRatio, 0, kernels.listLength(), sweep);
        return sweep;
    }
};

/// Slopes of each layer differ by up to 8, so that all buckets have samples.
LightField crowded(LightField field) {
    synthetic::Random random(11);
    for (LightFieldSample& s : field.samples) s.slope += 8 * (random.uniform() - 0.5f);
    return field;
}

std::vector<Field> fields() {
    std::vector<Field> made;
    for (const int spp : {1, 4, 16})
        made.emplace_back(crowded(synthetic::sample(synthetic::discsOverChecks(), kFrame, 15, spp, 3)));
    for (const synthetic::Counts& counts : synthetic::varyingCounts(kFrame))
        made.emplace_back(crowded(synthetic::sample(synthetic::discsOverChecks(), kFrame, 15, counts.at, 3)));
    return made;
}

std::vector<Output> someOutputs(int count) {
    const OutputPattern pattern = makeOutputPattern(64, 12);
    synthetic::Random random(29);
    std::vector<Output> outputs;
    for (int i = 0; i < count; ++i) {
        const ivec2 pixel(random.uniform() * float(kFrame.width()),
                          random.uniform() * float(kFrame.height()));
        outputs.push_back(outputAt(pixel, int(random.bits() % 64), pattern, 9));
    }
    return outputs;
}

/// Candidates that one side has and the other has not, and whose distance does not lie on the circle.
int differences(const Field& f, const test::BruteForce& truth, const Output& o, float radius,
                float maxRatio = kAnyRadiusRatio) {
    std::map<double, test::BruteForce::Seen> expected;
    for (const auto& s : truth.seen(o, double(radius) * (1 + 1e-5), double(maxRatio)))
        expected.emplace(s.sample.rgb.x, s);
    int different = 0;
    for (const Candidate& c : f.visited(o, radius, maxRatio).visited) {
        const auto found = expected.find(double(c.value.x));
        if (found == expected.end()) {
            ++different;
            continue;
        }
        const auto& [offset, distance, sample] = found->second;
        const double px = 1e-4; // rounding of numbers below 128, twice
        different += !(glm::length(offset - glm::dvec2(c.offset)) < px &&
                       std::abs(std::sqrt(double(c.distance2)) - distance) < px * sample.radiusRatio &&
                       double(c.slope) == sample.slope && double(c.weight) == sample.weight);
        expected.erase(found);
    }
    for (const auto& [id, s] : expected) different += s.distance < double(radius) * (1 - 1e-5);
    return different;
}

TEST(Candidates, areAllSamplesThatLandWithinTheRadius) {
    for (const Field& f : fields()) {
        const test::BruteForce truth(f.field, f.bins);
        for (const Output& o : someOutputs(60))
            for (const float widening : {1.f, 2.f, 16.f})
                ASSERT_EQ(differences(f, truth, o, widening * f.bins.grid.radiusPx), 0)
                    << f.field.samplesPerPixel << " spp, at " << o.xy.x << ' ' << o.xy.y;
    }
}

/// The layer map does not search within less than a texel.
TEST(Candidates, radiiNarrowNoFurtherThanAsked) {
    int narrower = 0;
    for (const Field& f : fields()) {
        const test::BruteForce truth(f.field, f.bins);
        for (const Output& o : someOutputs(60)) {
            for (const float maxRatio : {1.f, 1.5f, 2.f})
                ASSERT_EQ(differences(f, truth, o, 2 * f.bins.grid.radiusPx, maxRatio), 0) << maxRatio;
            narrower += truth.seen(o, truth.radius).size() < truth.seen(o, truth.radius, 1).size();
        }
    }
    EXPECT_GT(narrower, 60) << "counts that vary make a difference";
}

TEST(Candidates, comeFrontToBackUpToABucketAndInTheSameOrderEveryTime) {
    for (const Field& f : fields()) {
        const float bucket = 1 / f.bins.grid.invBucket;
        int back = 0;
        for (const Output& o : someOutputs(60)) {
            const auto visited = f.visited(o, 4 * f.bins.grid.radiusPx).visited;
            float furthest = -kInfinity;
            for (const Candidate& c : visited) {
                ASSERT_GT(c.slope, furthest - bucket * 1.0001f);
                back += c.slope < furthest;
                furthest = max(furthest, c.slope);
            }
            const auto again = f.visited(o, 4 * f.bins.grid.radiusPx).visited;
            ASSERT_EQ(visited.size(), again.size());
            for (std::size_t i = 0; i < visited.size(); ++i) ASSERT_EQ(visited[i].value, again[i].value);
        }
        EXPECT_GT(back, 0) << "samples within a bucket are not in order";
    }
}

TEST(Candidates, stopWhenTheSweepDoes) {
    const Field f(synthetic::sample(synthetic::discsOverChecks(), kFrame, 15, 4, 3));
    for (const Output& o : someOutputs(60)) {
        const SearchContext context{f.bins, f.allBricks};
        KeepingKernels kernels{context};
        KeepingKernels::Sweep all, some;
        const float radius = 2 * f.bins.grid.radiusPx;
        const int steps =
            kernels.forEachCandidate(f.bins.grid, o, radius, kAnyRadiusRatio, 0, kernels.listLength(), all);
        some.most = all.visited.size() / 2 + 1;
        const int fewer =
            kernels.forEachCandidate(f.bins.grid, o, radius, kAnyRadiusRatio, 0, kernels.listLength(), some);
        ASSERT_EQ(some.visited.size(), std::min(some.most, all.visited.size()));
        EXPECT_LE(fewer, steps);
        EXPECT_GE(steps, int(all.visited.size()));
    }
}

TEST(Candidates, bruteForceNoticesWhatIsWrong) {
    const Field f(crowded(synthetic::sample(synthetic::discsOverChecks(), kFrame, 15, 4, 3)));
    test::BruteForce fewer(f.field, f.bins), moved = fewer;
    std::erase_if(fewer.samples, [i = 0](const auto&) mutable { return ++i % 50 == 0; });
    for (auto& s : moved.samples) s.slope += 0.01;
    int missed = 0, off = 0;
    for (const Output& o : someOutputs(60)) {
        missed += differences(f, fewer, o, 2 * f.bins.grid.radiusPx);
        off += differences(f, moved, o, 2 * f.bins.grid.radiusPx) > 0;
    }
    EXPECT_GT(missed, 10);
    EXPECT_GT(off, 50);
}

} // namespace
} // namespace slant

// Trajectories in time (lib/motion.glsl), the bounds of bricks that move and the lists made from them, the
// motion of the layer map, and the pattern of moving fields: against the formula of lightfield.h in double
// precision.
#include "lib/map_reduce.glsl"
#include "lightfield/motion.h"
#include "reconstruct/candidates.h"
#include "reconstruct/map_lookup.h"
#include "reconstruct/output_pattern.h"
#include "reconstruct/points.h"
#include "reconstruct/tile_lists.h"
#include "support/draw.h"

#include <array>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <set>

namespace slant {
namespace {

const Rect kFrame{0, 0, 44, 36};

using test::Draw;

/// Where an output at time t through uv sees a sample: position and slope.
glm::dvec3 seenExactly(const LightField& field, std::size_t i, glm::dvec2 uv, double t) {
    const LightFieldSample& s = field.samples[i];
    const glm::dvec3 m(field.motion[i]);
    const double w = double(s.w), step = t - double(s.t);
    const glm::dvec2 p = glm::dvec2(s.x, s.y) - double(s.slope) * glm::dvec2(s.u, s.v);
    const glm::dvec3 moved = glm::dvec3(p * w, w) + step * m;
    const double c1 = double(field.slopeModel.c1), c2 = double(field.slopeModel.c2);
    const double slope = c1 / moved.z + c2;
    return {glm::dvec2(moved) / moved.z + slope * uv, slope};
}

/// Layers that move, with motions of their own for every sample.
LightField crowded(const std::vector<synthetic::MovingLayer>& layers, int spp, float spread) {
    LightField field = synthetic::sampleMoving(layers, kFrame, 20, spp, 3);
    Draw draw;
    for (std::size_t i = 0; i < field.samples.size(); ++i)
        field.motion[i] += field.samples[i].w * vec3(draw.place(-spread, spread), draw(-0.3f, 0.3f));
    EXPECT_EQ(sanitize(field).badMotion, 0u);
    return field;
}

Bins binsOf(const LightField& field) {
    const SceneSideSamples samples(field);
    Bins bins = binSamples(samples, {kFrame});
    takeValues(bins, samples, ValuePlane::radiance);
    return bins;
}

TEST(MotionKernel, followsTheLineOfItsSample) {
    const LightField field = crowded(synthetic::movingDiscs(), 2, 40);
    const SceneSideSamples samples(field);
    const Points points(samples);
    Draw draw;
    for (std::size_t i = 0; i < field.samples.size(); ++i) {
        const MovingPoint point = points[i];
        const vec2 uv = draw.place(-0.7f, 0.7f);
        const float t = draw(0, 1);
        const Trajectory at = atTime(point.trajectory, point.motion, t - 0.5f);
        const glm::dvec3 exact = seenExactly(field, i, glm::dvec2(uv), double(t));
        const vec2 seen = seenFrom(at, uv);
        ASSERT_NEAR(seen.x, exact.x, 2e-3) << "positions are below 256: 2^-16 each, magnified by depth";
        ASSERT_NEAR(seen.y, exact.y, 2e-3);
        ASSERT_NEAR(at.slope, exact.z, 1e-4 * (1 + std::abs(exact.z)));
        const float w = field.samples[i].w;
        ASSERT_NEAR(point.nearness * w, 1 / (1 + (0.5f - field.samples[i].t) * field.motion[i].z / w), 1e-4);
    }
}

TEST(MotionKernel, whatKeepsStillStaysToTheBit) {
    LightField field = synthetic::sampleMoving(synthetic::movingDiscs(), kFrame, 5, 2, 3);
    std::ranges::fill(field.motion, vec3(0));
    const SceneSideSamples samples(field);
    const Points points(samples);
    for (std::size_t i = 0; i < field.samples.size(); ++i) {
        const MovingPoint point = points[i];
        const Trajectory still = trajectoryOf(field.samples[i]), moved = atTime(still, point.motion, 0.4f);
        ASSERT_EQ(point.trajectory.pinhole, still.pinhole);
        ASSERT_EQ(point.trajectory.slope, still.slope);
        ASSERT_EQ(moved.pinhole, still.pinhole);
        ASSERT_EQ(moved.slope, still.slope);
    }
}

template <bool kMoving>
struct KeepingKernels {
#include "reconstruct/bin_fetches.h"

    struct Sweep {
        bool running = true;
        std::set<uint> visited; ///< values identify samples
    };
    static void visit(const Candidate& candidate, Sweep& sweep) {
        sweep.visited.insert(uint(candidate.value.x));
    }
    static bool hides(const Sweep&, const Brick&) {
        return false;
    }
#include "lib/search.glsl"
};

/// The lists and windows of bricks that move leave no sample out, and the search takes no other.
TEST(MotionKernel, searchesFindAllSamplesThatAreSeen) {
    for (const auto& layers : {synthetic::movingDiscs(), synthetic::overtakingDiscs()}) {
        LightField field = crowded(layers, 3, 25);
        for (std::size_t i = 0; i < field.samples.size(); ++i) field.radiance[i] = vec3(float(i), 0, 0);
        const Bins bins = binsOf(field);
        ASSERT_TRUE(bins.motion.moves());
        const OutputPattern pattern =
            makeOutputPattern(64, 12, 1, {}, {.moves = true, .velocityPx = bins.motion.fastestPx()});
        OutputLayout layout{};
        layout.regionOrigin = ivec2(kFrame.x0, kFrame.y0);
        layout.regionSize = ivec2(kFrame.width(), kFrame.height());
        layout.tileCount = (layout.regionSize + kTileSize - 1) / kTileSize;
        const float radius = 2 * bins.grid.radiusPx;
        const BrickOrders orders(bins.motion, bins.brickRanks, pattern.slotTimes());
        GroupSight sight;
        sight.tilesOf = [&](uint brick, std::size_t group) {
            return tilesSeeing(bins, brick, layout, pattern.groups[group], pattern.times[group], radius);
        };
        sight.brickAt = [&](std::size_t group, std::size_t rank) {
            return orders.at(pattern.slotOf(group), rank);
        };
        const TileLists lists = makeTileLists(bins, layout, pattern.groups.size(), sight);
        Draw draw;
        std::size_t found = 0;
        for (int k = 0; k < 150; ++k) {
            const ivec2 pixel(draw.place(0, 1) * vec2(kFrame.width(), kFrame.height()));
            const int index = int(draw.random.bits() % 64);
            const Output o = outputAt(pixel, index, pattern, 9);
            const ivec2 tile = pixel / kTileSize;
            const auto list = std::size_t((index >> pattern.groupBits) * layout.tileCount.y + tile.y) *
                                  std::size_t(layout.tileCount.x) +
                              std::size_t(tile.x);
            const SearchContext context{
                bins, std::span(lists.bricks)
                          .subspan(lists.start[list], lists.start[list + 1] - lists.start[list])};
            KeepingKernels<true> kernels{context};
            KeepingKernels<true>::Sweep sweep;
            kernels.forEachCandidate(bins.grid, o, radius, kAnyRadiusRatio, 0, kernels.listLength(), sweep);
            for (std::size_t i = 0; i < field.samples.size(); ++i) {
                const glm::dvec3 seen = seenExactly(field, i, glm::dvec2(o.uv), double(o.t));
                const double distance = glm::length(glm::dvec2(seen) - glm::dvec2(o.xy));
                const bool visited = sweep.visited.contains(uint(i));
                if (std::abs(distance - double(radius)) < 5e-3) continue; // rounding decides
                ASSERT_EQ(visited, distance < double(radius)) << "sample " << i << ", time " << o.t;
            }
            found += sweep.visited.size();
        }
        EXPECT_GT(found, 150u * 10);
    }
}

/// Bricks come front to back at the middle of each slot of time.
TEST(MotionKernel, bricksAreInTheOrderOfTheirDepth) {
    const Bins bins = binsOf(crowded(synthetic::overtakingDiscs(), 3, 0));
    ASSERT_TRUE(bins.motion.changesDepth);
    const std::vector<float> times = {-0.4f, 0, 0.4f};
    const BrickOrders orders(bins.motion, bins.brickRanks, times);
    for (std::size_t slot = 0; slot < times.size(); ++slot) {
        std::set<uint> all;
        float before = -kInfinity;
        for (std::size_t rank = 0; rank < bins.bricks.size(); ++rank) {
            const uint brick = orders.at(slot, rank);
            const float here = rankAt(bins.brickRanks[brick].x, bins.brickRanks[brick].y, times[slot]);
            ASSERT_GE(here, before);
            before = here;
            all.insert(brick);
        }
        EXPECT_EQ(all.size(), bins.bricks.size());
    }
}

/// A brick holds one class of velocities.
TEST(MotionKernel, bricksAreOfOneVelocity) {
    const LightField field = crowded(synthetic::movingDiscs(), 3, 30);
    const Bins bins = binsOf(field);
    const float step = 1 / bins.motion.layout.invVelocity;
    const uint cells = uint(bins.grid.cellsPerBrick * bins.grid.cellsPerBrick);
    for (std::size_t brick = 0; brick < bins.bricks.size(); ++brick) {
        vec2 low(kInfinity), high(-kInfinity);
        for (uint i = bins.cellStart[brick * cells]; i < bins.cellStart[(brick + 1) * cells]; ++i) {
            low = min(low, vec2(bins.motions[i]));
            high = max(high, vec2(bins.motions[i]));
        }
        const vec2 outermost = vec2(float(std::max(kFrame.width(), kFrame.height())));
        if (any(lessThan(low, -outermost + step)) || any(greaterThan(high, outermost - step))) continue;
        ASSERT_LE(std::max(high.x - low.x, high.y - low.y), step * 1.0001f);
    }
}

TEST(MotionKernel, layersOfTheMapKeepTheirMotion) {
    MotionLayout layout{};
    layout.velocityMin = {-30, -50};
    layout.invVelocity = 0.25f;
    layout.velocityCount = {20, 30}; // to 50, 70
    const vec2 half = 0.5f * layout.velocityCount * 4.f / kVelocitySteps;
    Draw draw;
    for (int i = 0; i < 20000; ++i) {
        const vec3 motion(draw(-30, 50), draw(-50, 70), draw(-0.9f, 4));
        const vec3 back = unpackMotion(packMotion(motion, layout), layout);
        ASSERT_NEAR(back.x, motion.x, half.x * 1.01f);
        ASSERT_NEAR(back.y, motion.y, half.y * 1.01f);
        ASSERT_EQ(back.z, motion.z);
    }
    EXPECT_NEAR(unpackMotion(packMotion({1e9f, -1e9f, 0}, layout), layout).x, 50, 1e-4);
}

/// Layers of one slope that move differently stay apart on coarser levels; those that move alike become one.
TEST(MotionKernel, coarserLevelsPartWhatMovesDifferently) {
    MotionLayout motion{};
    motion.velocityMin = {-64, -64};
    motion.invVelocity = 0.25f;
    motion.velocityCount = {32, 32};
    const SlopeCode code{-10, 0.01f, 100};
    const vec3 still(0), fast(30, -20, 0.25f);
    Children children;
    ChildMotions moving;
    for (int i = 0; i < 4; ++i) {
        MapTexel texel;
        texel.layers[0] = {vec3(1, 0, 0), 0.5f, 2, i < 2 ? fast : still};
        texel.layers[1] = {vec3(0, 1, 0), 1, 2.5f, i < 2 ? still : fast};
        texel.count = i == 3 ? 1 : 2;
        setChild(children, i, packTexel(texel, code), code);
        setMotion(moving, i, packMotions(texel, motion), motion);
    }
    const MovingLayers coarse = reducedMoving(children, moving, 1, code, motion);
    const MapTexel texel = unpackTexel(coarse.words, code);
    ASSERT_EQ(texel.count, 2);
    const vec3 front = unpackMotion(uvec2(coarse.motions), motion),
               back = unpackMotion(uvec2(coarse.motions.z, coarse.motions.w), motion);
    EXPECT_NEAR(front.x, 30, 0.01);
    EXPECT_NEAR(front.z, 0.25, 0.01);
    EXPECT_NEAR(back.y, 0, 0.01);
    EXPECT_NEAR(texel.layers[0].coverage, (0.5 + 0.5 + 1) / 4, 0.01) << "two at 2, one at 2.5";
    EXPECT_NEAR(texel.layers[1].coverage, (1 + 1 + 0.5 + 0.5) / 4, 0.01);
    EXPECT_NEAR(texel.layers[0].slope, (2 * 1 + 2.5) / 2, 0.01) << "weighted by coverage";
}

/// Lists of bricks as (slope, velocity along x), and the clusters that they make.
TEST(MotionKernel, clustersAreOfSlopeAndVelocity) {
    struct Case {
        std::vector<vec2> bricks;
        std::size_t clusters; ///< 0: the map does not serve it
    };
    MapLayout map{};
    map.surfaceGap = 1;
    map.reachPx = 100;
    map.texelsPerPixel = 2;
    map.levels = 1;
    map.radiusPx = 1;
    for (const Case& c :
         {Case{{{5, 0}}, 1},
          {{{5, 0}, {5.2f, 30}}, 2},
          {{{5, 0}, {9, 0}}, 2},
          {{{5, 0}, {5.2f, 30}, {5.4f, 1}}, 2},   // what keeps still lies behind, too
          {{{5, 0}, {5.2f, 3}, {5.4f, 1.5f}}, 0}, // joined by the third, after they were parted
          {{{5, 0}, {5.2f, 1.5f}, {5.4f, 3}}, 1},
          {{{5, 250}}, 0}}) { // beyond the map
        Bins bins;
        std::vector<uint> ids;
        for (const vec2 brick : c.bricks) {
            ids.push_back(uint(bins.bricks.size()));
            bins.bricks.push_back({0, uint(kRadiusSteps) << 12, brick.x, brick.x});
            bins.brickMotions.push_back({vec2(brick.y, 0), vec2(brick.y, 0), vec2(0), vec2(0)});
        }
        bins.motion.layers = {0};
        const LensBox lens{vec2(-1), vec2(1)};
        EXPECT_EQ(classOfList(bins, ids, sightThrough(lens, 1), vec2(-0.5f, 0.5f), map).clusters.size(),
                  c.clusters)
            << c.bricks.size() << " bricks, the last at " << c.bricks.back().y;
    }
}

TEST(MotionKernel, blurOfDiscAndLineCoversTheirSum) {
    for (const float slope : {0.f, 1.f, 7.f, 30.f})
        for (const float speed : {0.f, 3.f, 90.f}) {
            const double area = std::numbers::pi * double(slope) * double(slope) + 2 * double(slope * speed);
            const double spread = double(blurSpread(slope, speed));
            EXPECT_NEAR(std::numbers::pi * spread * spread, area, 1e-5 * area);
        }
    EXPECT_EQ(blurSpread(-3, 10), 0) << "in focus somewhere";
    for (int i = 1; i < 1000; ++i) EXPECT_EQ(blurSpread(0.37f * float(i), 0), 0.37f * float(i));
}

/// Each output of a pixel has its own part of the shutter; groups are narrow in lens and time.
TEST(MotionKernel, patternsCutTheShutter) {
    for (const auto& [slope, velocity, slots] :
         {std::tuple(0.f, 100.f, 4), {100.f, 0.f, 0}, {20.f, 40.f, 1}, {3.f, 100.f, 4}}) {
        const OutputPattern pattern = makeOutputPattern(
            128, slope, 1, {}, {.moves = true, .velocityPx = velocity, .open = 0.2f, .span = 0.5f});
        EXPECT_EQ(pattern.slotBits, slots) << slope << ' ' << velocity;
        std::set<uint> parts;
        for (int k = 0; k < 128; ++k) {
            parts.insert(pattern.entries[std::size_t(k)].z);
            const std::size_t group = std::size_t(k >> pattern.groupBits);
            for (const ivec2 pixel : {ivec2(3, 5), ivec2(-8, 100)}) {
                const Output o = outputAt(pixel, k, pattern, 77);
                ASSERT_GE(o.t - 0.5f, pattern.times[group].x - 1e-6f);
                ASSERT_LE(o.t - 0.5f, pattern.times[group].y + 1e-6f);
                const float middle = pattern.slotTimes()[pattern.slotOf(group)];
                ASSERT_NEAR(o.t - 0.5f, middle, 0.5f * 0.5f / float(1 << slots) + 1e-6f);
            }
        }
        EXPECT_EQ(parts.size(), 128u);
        EXPECT_EQ(*parts.rbegin(), 127u);
    }
}

} // namespace
} // namespace slant

// The grid (lib/grid.glsl): where samples are binned, and that no tile misses a brick that it can see,
// against positions in double precision.
#include "reconstruct/kernels.h"
#include "reconstruct/tile_lists.h"
#include "support/synthetic.h"

#include <gtest/gtest.h>
#include <set>

namespace slant {
namespace {

const Rect kFrame{-3, 5, 61, 50};
/// Of positions up to some hundred pixels, in single precision.
constexpr double kRounding = 1e-3;

struct Draw {
    synthetic::Random random{19};

    double operator()(double low, double high) { return low + (high - low) * double(random.uniform()); }
    glm::dvec2 inside(glm::dvec2 low, glm::dvec2 high) {
        const double x = (*this)(low.x, high.x);
        return {x, (*this)(low.y, high.y)};
    }
};

struct Field {
    LightField field;
    Bins bins;

    explicit Field(LightField made) : field(std::move(made)) {
        synthetic::Random random(11);
        for (LightFieldSample& s : field.samples) s.slope += 4 * (random.uniform() - 0.5f);
        bins = binSamples(SceneSideSamples(field), {kFrame});
    }
};

std::vector<Field> fields() {
    std::vector<Field> made;
    for (const int spp : {1, 4, 16})
        made.emplace_back(synthetic::sample(synthetic::discsOverChecks(), kFrame, 15, spp, 3));
    for (const synthetic::Counts& counts : synthetic::varyingCounts(kFrame))
        made.emplace_back(synthetic::sample(synthetic::discsOverChecks(), kFrame, 15, counts.at, 3));
    return made;
}

/// The brick of each record.
std::vector<std::size_t> bricksOf(const Bins& bins) {
    const std::size_t cells = std::size_t(bins.grid.cellsPerBrick) * std::size_t(bins.grid.cellsPerBrick);
    std::vector<std::size_t> bricks(bins.samples.size());
    for (std::size_t brick = 0; brick < bins.bricks.size(); ++brick)
        for (uint record = bins.cellStart[brick * cells]; record < bins.cellStart[(brick + 1) * cells];
             ++record)
            bricks[record] = brick;
    return bricks;
}

glm::dvec2 pinholeOf(const LightFieldSample& s) {
    return glm::dvec2(s.x, s.y) - double(s.slope) * glm::dvec2(s.u, s.v);
}

TEST(Grid, samplesLieInTheirCellsAndBuckets) {
    for (const Field& f : fields()) {
        const GridLayout& grid = f.bins.grid;
        const double cellPx = 1 / double(grid.invCell), bucket = 1 / double(grid.invBucket);
        const int side = grid.cellsPerBrick;
        std::size_t binned = 0;
        for (const LightFieldSample& s : f.field.samples) {
            const glm::dvec2 p = pinholeOf(s);
            if (!reaches(trajectoryOf(s), vec2(kFrame.x0, kFrame.y0), vec2(kFrame.x1, kFrame.y1), 10))
                continue;
            ++binned;
            const uint key = sortKey(grid, pinholePosition(s), bucketOf(grid, s.slope));
            const uint cells = uint(side * side), brick = key / cells;
            const ivec2 place(int(brick) % grid.brickCount.x,
                              int(brick) / grid.brickCount.x % grid.brickCount.y);
            const int slopes = int(brick) / (grid.brickCount.x * grid.brickCount.y);
            const ivec2 cell = side * place + ivec2(int(key % cells) % side, int(key % cells) / side);
            for (int axis = 0; axis < 2; ++axis) {
                const double low = double(grid.origin[axis]) + cell[axis] * cellPx;
                const bool first = cell[axis] == 0, last = cell[axis] == grid.brickCount[axis] * side - 1;
                ASSERT_TRUE(first || p[axis] >= low - kRounding);
                ASSERT_TRUE(last || p[axis] <= low + cellPx + kRounding);
            }
            const double front = double(grid.slopeMin) + slopes * bucket;
            ASSERT_TRUE(slopes == 0 || s.slope >= front - 1e-4);
            ASSERT_TRUE(slopes == grid.bucketCount - 1 || s.slope <= front + bucket + 1e-4);
        }
        EXPECT_GT(binned, f.field.samples.size() / 3);
    }
}

TEST(Grid, bricksHoldTheirSamples) {
    for (const Field& f : fields()) {
        const std::vector<std::size_t> bricks = bricksOf(f.bins);
        std::vector<float> least(f.bins.bricks.size(), kInfinity), most(f.bins.bricks.size(), -kInfinity),
            ratio(f.bins.bricks.size(), kInfinity);
        for (std::size_t record = 0; record < bricks.size(); ++record) {
            const std::size_t i = bricks[record];
            const BrickBox box = boxOf(f.bins.bricks[i], f.bins.grid);
            const LightFieldSample& s = f.field.samples[f.bins.samples[record]];
            const glm::dvec2 p = pinholeOf(s);
            ASSERT_TRUE(p.x > double(box.low.x) - kRounding && p.y > double(box.low.y) - kRounding &&
                        p.x < double(box.high.x) + kRounding && p.y < double(box.high.y) + kRounding);
            least[i] = min(least[i], s.slope), most[i] = max(most[i], s.slope);
            ratio[i] = min(ratio[i], f.bins.values[record].w);
        }
        for (std::size_t i = 0; i < f.bins.bricks.size(); ++i) {
            EXPECT_EQ(f.bins.bricks[i].slopeMin, least[i]);
            EXPECT_EQ(f.bins.bricks[i].slopeMax, most[i]);
            EXPECT_GE(widestRadius(f.bins.bricks[i]), 1 / ratio[i]);
            EXPECT_LE(widestRadius(f.bins.bricks[i]), 1 / ratio[i] + 2 / kRadiusSteps);
        }
    }
}

OutputLayout tilesOf(const Rect& region) {
    OutputLayout layout{};
    layout.regionOrigin = {region.x0, region.y0};
    layout.regionSize = {region.width(), region.height()};
    layout.tileCount = (layout.regionSize + kTileSize - 1) / kTileSize;
    return layout;
}

/// Every brick against the places where its box is seen: none of these misses its tile, and the outermost
/// tiles are those of such places.
TEST(Grid, tilesOfABrickAreThoseThatSeeItsBox) {
    const OutputLayout tiles = tilesOf({-40, -40, 120, 100});
    Draw draw;
    for (int i = 0; i < 1500; ++i) {
        GridLayout grid{};
        grid.origin = vec2(draw.inside({-60, -60}, {-40, -40}));
        grid.invCell = float(draw(0.4, 3));
        grid.cellsPerBrick = 8;
        grid.brickCount = {1000, 1000};
        const ivec2 first(draw.inside({1, 1}, {300, 300})), extent(draw.inside({0, 0}, {7.9, 7.9}));
        const float slope = float(draw(-20, 20)), wide = float(draw(0, 1)), ownRadius = float(draw(0.2, 1));
        const uint radius = uint(std::ceil(double(kRadiusSteps) * double(ownRadius)));
        const Brick brick{uint(first.x | first.y << 16), uint(extent.x | extent.y << 6) | radius << 12, slope,
                          slope + wide};
        const glm::dvec2 a = draw.inside({-1, -1}, {1, 1}), b = draw.inside({-1, -1}, {1, 1});
        const LensBox lens{vec2(min(a, b)), vec2(max(a, b))};
        const double marginPx = draw(0.5, 7);
        const TileRange range = tilesSeeing(brick, grid, tiles, lens, float(marginPx));
        const double ownPx = min(marginPx, max(marginPx * double(ownRadius), double(kMinMarginPx)));

        const glm::dvec2 low = glm::dvec2(grid.origin) + glm::dvec2(first) / double(grid.invCell);
        const glm::dvec2 high =
            glm::dvec2(grid.origin) + glm::dvec2(first + extent + 1) / double(grid.invCell);
        glm::dvec2 least(1e9), most(-1e9); // of where it is seen
        for (int k = 0; k < 400; ++k) {
            // Corners first, then anything.
            const auto at = [&](int bit, double from, double to) {
                return k < 16 ? (k >> bit & 1 ? to : from) : draw(from, to);
            };
            const double s = at(0, double(brick.slopeMin), double(brick.slopeMax));
            const glm::dvec2 uv(at(1, double(lens.min.x), double(lens.max.x)),
                                at(1, double(lens.min.y), double(lens.max.y)));
            const glm::dvec2 p(at(2, low.x, high.x), at(2, low.y, high.y));
            const glm::dvec2 off = glm::dvec2(at(3, -ownPx, ownPx), at(3, -ownPx, ownPx));
            const glm::dvec2 xy = p + s * uv + off;
            least = min(least, xy), most = max(most, xy);
            const glm::dvec2 tile = floor((xy - glm::dvec2(tiles.regionOrigin)) / double(kTileSize));
            for (int axis = 0; axis < 2; ++axis) {
                if (tile[axis] < 0 || tile[axis] >= tiles.tileCount[axis]) continue;
                ASSERT_GE(tile[axis], range.first[axis]) << i;
                ASSERT_LT(tile[axis], range.last[axis]) << i;
            }
        }
        for (int axis = 0; axis < 2; ++axis) {
            const auto tileOf = [&](double px) {
                return std::floor((px - tiles.regionOrigin[axis]) / kTileSize);
            };
            ASSERT_GE(range.first[axis], std::max(tileOf(least[axis] - kRounding), 0.0)) << i;
            ASSERT_LE(range.last[axis],
                      std::min(tileOf(most[axis] + kRounding) + 1, double(tiles.tileCount[axis])))
                << i;
        }
    }
}

/// What is listed for each tile and group, and what dense random places say is needed.
struct Listed {
    int missing = 0;            ///< places that a list does not serve
    std::size_t pairs = 0;      ///< of lists and bricks
    std::set<std::size_t> used; ///< of them
};

Listed listed(const Field& f, float marginPx, float listMarginPx) {
    const OutputLayout tiles = tilesOf(kFrame);
    const OutputPattern pattern = makeOutputPattern(64, 14);
    const TileLists lists = makeTileLists(f.bins, tiles, pattern.groups, listMarginPx);
    const std::vector<std::size_t> bricks = bricksOf(f.bins);
    Draw draw;
    Listed found;
    found.pairs = lists.bricks.size();
    for (std::size_t record = 0; record < f.bins.samples.size(); ++record)
        for (std::size_t group = 0; group < pattern.groups.size(); ++group) {
            const LightFieldSample& s = f.field.samples[f.bins.samples[record]];
            const LensBox& box = pattern.groups[group];
            const glm::dvec2 uv = draw.inside(box.min, box.max);
            const double angle = draw(0, 6.28),
                         ownPx = 0.999 * double(marginPx) / double(f.bins.values[record].w);
            const glm::dvec2 xy =
                pinholeOf(s) + double(s.slope) * uv + ownPx * glm::dvec2(cos(angle), sin(angle));
            const glm::dvec2 place = xy - glm::dvec2(tiles.regionOrigin);
            if (place.x < 0 || place.y < 0 || place.x >= kFrame.width() || place.y >= kFrame.height())
                continue;
            const ivec2 tile(place / double(kTileSize));
            const std::size_t list = (group * std::size_t(tiles.tileCount.y) + std::size_t(tile.y)) *
                                         std::size_t(tiles.tileCount.x) +
                                     std::size_t(tile.x);
            const auto begin = lists.bricks.begin() + lists.start[list],
                       end = lists.bricks.begin() + lists.start[list + 1];
            found.missing += !std::binary_search(begin, end, uint(bricks[record]));
            found.used.insert(list * f.bins.bricks.size() + bricks[record]);
        }
    return found;
}

TEST(Grid, listsHaveEveryBrickThatAnOutputCanSee) {
    for (const Field& f : fields())
        for (const float widening : {1.f, 2.f, 16.f}) {
            const float marginPx = widening * f.bins.grid.radiusPx;
            EXPECT_EQ(listed(f, marginPx, marginPx).missing, 0) << f.field.samplesPerPixel << ' ' << widening;
        }
}

/// Boxes of bricks are larger than what their samples fill. Measured: 1.3 to 1.8 pairs for each one used.
TEST(Grid, listsHaveFewBricksThatNoOutputSees) {
    for (const Field& f : fields()) {
        if (f.field.samples.size() < 3 * f.field.bounds.area()) continue; // too few to tell what can be seen
        const Listed found = listed(f, f.bins.grid.radiusPx, f.bins.grid.radiusPx);
        EXPECT_LT(double(found.pairs) / double(found.used.size()), 2) << f.field.samplesPerPixel;
    }
}

TEST(Grid, listsOfTooSmallAMarginAreNoticed) {
    const Field f(synthetic::sample(synthetic::discsOverChecks(), kFrame, 15, 4, 3));
    EXPECT_GT(listed(f, 4, 1).missing, 50);
}

} // namespace
} // namespace slant

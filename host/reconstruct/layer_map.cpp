#include "reconstruct/layer_map.h"

#include "base/error.h"
#include "base/parallel.h"
#include "lib/map_reduce.glsl"
#include "reconstruct/kernels.h"
#include "reconstruct/lens_tiles.h"

#include <algorithm>
#include <limits>

namespace slant {
namespace {

/// Wider margins take more memory and time than they save.
constexpr float kMaxReachPx = 128;

/// Down or up to a multiple of kMapAlignPx.
ivec2 aligned(vec2 px, bool up) {
    const vec2 steps = px / float(kMapAlignPx);
    return kMapAlignPx * ivec2(up ? glm::ceil(steps) : glm::floor(steps));
}

struct Box {
    vec2 low, high;
};

/// Around the bricks of a grid, on the film. A distorted side is farthest out where it is nearest to the
/// middle of the film, or at an end.
Box boxOnFilm(const GridLayout& grid, const LensDistortion& distortion) {
    const vec2 extent = vec2(grid.brickCount * grid.cellsPerBrick) / grid.invCell;
    const Box box{grid.origin, grid.origin + extent};
    if (distortion.empty()) return box;
    const vec2 middle = glm::clamp(distortion.centre(), box.low, box.high);
    Box bounds{vec2(kInfinity), vec2(-kInfinity)};
    for (const float x : {box.low.x, middle.x, box.high.x})
        for (const float y : {box.low.y, middle.y, box.high.y}) {
            const vec2 place = distortion.onFilm({x, y});
            bounds = {glm::min(bounds.low, place), glm::max(bounds.high, place)};
        }
    return bounds;
}

} // namespace

int mapTexelsPerPixel(const LightField& field) {
    // With two or more samples per pixel, wider texels soften what is in focus.
    return sampleCounts(field).max <= 1 ? 1 : kMaxTexelsPerPixel;
}

float mapReach(const GridLayout& grid, const MotionGrid& motion, float lensScale,
               const LensDistortion& distortion) {
    const float reach = distortion.pupilReach() * lensScale * largestSlope(grid) + 0.5f * motion.fastestPx();
    return glm::min(reach, kMaxReachPx / distortion.steepest());
}

LensDistortion distortionOver(const Rect& region, const LensMap& lens) {
    if (lens.empty()) return {};
    const vec2 centre(lens.texels()[0]), low(float(region.x0), float(region.y0)),
        high(float(region.x1), float(region.y1));
    const vec2 farthest = glm::max(glm::abs(low - centre), glm::abs(high - centre));
    return LensDistortion(lens, glm::length(farthest + 2 * kMaxReachPx));
}

float mapMarginPx(float reachPx, const LensDistortion& distortion) {
    return distortion.steepest() * reachPx + distortion.aberrationPx();
}

int mapRows(const Rect& frame, int texels, float marginPx, bool moves, std::uint64_t bytes) {
    const double margin = 2 * (double(marginPx) + 3 * kMapAlignPx);
    const double rowTexels = (frame.width() + margin) * texels * texels * 4 / 3; // with all levels
    const double rowBytes = rowTexels * sizeof(glm::uvec4) * (moves ? 2 : 1);
    const double rows = double(bytes) / rowBytes - margin;
    if (rows < kTileSize)
        throw Error(
            ErrorCode::resources,
            fmt::format("the memory budget is too small for a picture {} pixels wide with blur of {:.0f} "
                        "pixels: for its layer map it has to be {:.0f} MiB",
                        frame.width(), marginPx, 2 * rowBytes * (kTileSize + margin) / (1 << 20) + 1));
    return int(std::min(rows, double(frame.height() + kTileSize)));
}

MapLayout chooseMap(const GridLayout& grid, const MotionGrid& motion, const Rect& region, int texels,
                    float reachPx, float spreadPerPx, const LensDistortion& distortion) {
    const float margin = mapMarginPx(reachPx, distortion) +
                         float(2 * kMapAlignPx); // tiles beyond the region, the coarsest texels
    const Box samples = boxOnFilm(grid, distortion);
    const vec2 low = glm::max(vec2(float(region.x0), float(region.y0)) - margin, samples.low);
    const vec2 high = glm::min(vec2(float(region.x1), float(region.y1)) + margin, samples.high);
    MapLayout map{};
    map.origin = aligned(low, false);
    map.texelsPerPixel = texels;
    map.size = texels * glm::max(aligned(high, true) - map.origin, ivec2(kMapAlignPx));
    map.surfaceGap = grid.surfaceGap;
    map.reachPx = reachPx;
    map.spreadPerPx = spreadPerPx;
    map.code = slopeCode(grid);
    map.radiusPx = grid.radiusPx;
    map.tentPx = glm::max(1.f / float(texels), grid.radiusPx);
    map.levels = 1;
    for (float spacing = float(texels) * spreadPerPx * blurSpread(largestSlope(grid), motion.fastestPx());
         spacing >= kLevelSpacing && (1 << map.levels) <= kMapAlignPx * texels; spacing *= 0.5f)
        ++map.levels;
    return map;
}

ivec2 levelSize(const MapLayout& map, int level) {
    ivec2 size = map.size;
    for (; level > 0; --level) size /= 2;
    return size;
}

std::size_t levelBegin(const MapLayout& map, int level) {
    std::size_t begin = 0;
    for (int below = 0; below < level; ++below) {
        const ivec2 size = levelSize(map, below);
        begin += std::size_t(size.x) * size.y;
    }
    return begin;
}

OutputLayout mapTiles(const MapLayout& map) {
    OutputLayout layout{};
    layout.regionOrigin = map.origin;
    layout.regionSize = map.size / map.texelsPerPixel;
    layout.tileCount = layout.regionSize / kTileSize;
    layout.outputsPerPixel = map.texelsPerPixel * map.texelsPerPixel;
    return layout;
}

OutputPattern mapPattern() {
    OutputPattern pattern;
    pattern.groups = pattern.cells = {{vec2(0), vec2(0)}};
    return pattern;
}

vec2 texelCenter(const MapLayout& map, ivec2 texel) {
    return vec2(map.origin) + (vec2(texel) + 0.5f) * (1.f / float(map.texelsPerPixel));
}

namespace {

template <bool kMoving>
struct MapSweepKernels {
#include "reconstruct/bin_fetches.h"

    using LayerTexel = MapTexel;

    static LayerTexel noLayers() {
        return {};
    }
    static void keepLayer(vec3 rgb, float coverage, float slope, vec3 motion, const SlopeCode&,
                          LayerTexel& texel) {
        texel.layers[std::size_t(texel.count++)] = {rgb, coverage, slope, motion};
    }
#include "lib/map_sweep.glsl"

#include "lib/search.glsl"
};

/// The layers of the samples within `searchRadius`.
template <typename Kernels>
MapTexel resolveWithin(const SearchContext& context, const MapLayout& map, const Output& place,
                       float searchRadius) {
    const GridLayout& grid = context.bins.grid;
    Kernels kernels{context};
    auto sweep = kernels.newSweep(grid, map.tentPx, float(map.texelsPerPixel), map.code);
    kernels.forEachCandidate(grid, place, searchRadius, sweep.maxRadiusRatio, 0, kernels.listLength(), sweep);
    if (sweep.surface.count > 0) kernels.close(sweep, true);
    return sweep.texel;
}

} // namespace

MapTexel resolveTexel(const SearchContext& context, const MapLayout& map, const LensMap& pinhole,
                      ivec2 texel) {
    Output place = outputOnFilm(texelCenter(map, texel), vec2(0), 0.5f, 0);
    if (!pinhole.empty()) toSceneSide(pinhole, place);
    if (!(place.weight > 0)) return {}; // beyond the lens map
    const auto resolve = context.bins.motion.moves() ? resolveWithin<MapSweepKernels<true>>
                                                     : resolveWithin<MapSweepKernels<false>>;
    const MapTexel found = resolve(context, map, place, map.tentPx);
    return found.count > 1 ? resolve(context, map, place, 2 * map.tentPx) : found;
}

void reduceLevel(LayerMap& map, int level) {
    const MapLayout& layout = map.layout;
    const ivec2 below = levelSize(layout, level - 1), size = levelSize(layout, level);
    const std::size_t source = levelBegin(layout, level - 1), target = levelBegin(layout, level);
    parallelFor(0, std::size_t(size.y), 8, [&](std::size_t first, std::size_t last) {
        for (int y = int(first); y < int(last); ++y)
            for (int x = 0; x < size.x; ++x) {
                Children children;
                ChildMotions moving;
                const std::size_t texel = target + std::size_t(y) * size.x + x;
                for (int i = 0; i < 4; ++i) {
                    const std::size_t column = 2 * std::size_t(x) + std::size_t(i % 2),
                                      row = 2 * std::size_t(y) + std::size_t(i / 2);
                    const std::size_t child = source + row * below.x + column;
                    setChild(children, i, map.texels[child], layout.code);
                    if (!map.motions.empty()) setMotion(moving, i, map.motions[child], map.motionLayout);
                }
                if (map.motions.empty()) {
                    map.texels[texel] = reduced(children, layout.surfaceGap, layout.code);
                    continue;
                }
                const MovingLayers layers =
                    reducedMoving(children, moving, layout.surfaceGap, layout.code, map.motionLayout);
                map.texels[texel] = layers.words;
                map.motions[texel] = layers.motions;
            }
    });
}

namespace {

/// Lists for outputs through the lens's centre in the middle of the shutter.
TileLists listsInTheMiddle(const Bins& bins, const OutputLayout& tiles, const LensMap& pinhole,
                           float marginPx) {
    const OutputPattern pattern = mapPattern();
    const float middle = 0;
    const BrickOrders orders(bins.motion, bins.brickRanks, {&middle, 1});
    LensTiles lensTiles;
    if (!pinhole.empty()) lensTiles = lensTilesOf(pinhole, pattern, 0, 1, bins.grid, tiles, marginPx);
    const auto tilesOf = [&](uint brick, std::size_t group) {
        if (pinhole.empty())
            return tilesSeeing(bins.bricks[brick], bins.grid, tiles, pattern.groups[0], marginPx);
        return tilesOfCompoundLens(bins, brick, tiles, lensTiles.bounds, group, vec2(0));
    };
    const auto brickAt = [&](std::size_t, std::size_t rank) { return orders.at(0, rank); };
    GroupSight sight{tilesOf, brickAt};
    if (!pinhole.empty())
        sight.sees = [&](uint brick, std::size_t, std::size_t list) {
            return listSees(bins, brick, lensTiles, list, vec2(0));
        };
    return makeTileLists(bins, tiles, 1, sight);
}

} // namespace

LayerMap makeLayerMap(const Bins& bins, const MapLayout& layout, const LensDistortion& distortion) {
    LayerMap map;
    map.layout = layout;
    map.texels.resize(levelBegin(layout, layout.levels));
    if (bins.motion.moves()) map.motions.resize(map.texels.size());
    map.motionLayout = bins.motion.layout;
    map.distortion = distortion.texels();

    const OutputLayout tiles = mapTiles(layout);
    const TileLists lists = listsInTheMiddle(bins, tiles, distortion.pinhole(), 2 * layout.tentPx);
    parallelFor(0, std::size_t(layout.size.y), 8, [&](std::size_t first, std::size_t last) {
        for (int y = int(first); y < int(last); ++y)
            for (int x = 0; x < layout.size.x; ++x) {
                const ivec2 tile = ivec2(x, y) / (kTileSize * layout.texelsPerPixel);
                const std::size_t list = std::size_t(tile.y) * tiles.tileCount.x + tile.x;
                const std::span<const uint> bricks(lists.bricks.data() + lists.start[list],
                                                   lists.start[list + 1] - lists.start[list]);
                const MapTexel texel =
                    resolveTexel({bins, bricks}, layout, distortion.pinhole(), ivec2(x, y));
                const std::size_t place = std::size_t(y) * layout.size.x + x;
                map.texels[place] = packTexel(texel, layout.code);
                if (bins.motion.moves()) map.motions[place] = packMotions(texel, bins.motion.layout);
            }
    });
    for (int level = 1; level < layout.levels; ++level) reduceLevel(map, level);
    return map;
}

} // namespace slant

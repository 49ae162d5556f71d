#include "reconstruct/layer_map.h"

#include "base/error.h"
#include "base/parallel.h"
#include "reconstruct/surface.h"

#include <algorithm>
#include <limits>

namespace slant {
namespace {

/// Wider margins take more memory and time than they save.
constexpr float kMaxReachPx = 128;

/// Adds a layer to a texel that has room for it. What has nothing before or behind it fills the texel.
void close(MapTexel& texel, const Surface& surface, float fullWeight, bool last) {
    if (!(surface.innerWeight > 0)) return;
    const bool full = (last && texel.count == 0) || isSolid(surface, fullWeight);
    const float coverage = full ? 1.f : glm::min(surface.innerWeight / fullWeight, 1.f);
    texel.layers[std::size_t(texel.count++)] = {surface.innerSum / surface.innerWeight, coverage,
                                                surface.slopeSum / surface.innerWeight};
}

/// Down or up to a multiple of kMapAlignPx.
ivec2 aligned(vec2 px, bool up) {
    const vec2 steps = px / float(kMapAlignPx);
    return kMapAlignPx * ivec2(up ? glm::ceil(steps) : glm::floor(steps));
}

} // namespace

int mapTexelsPerPixel(const LightField& field) {
    // From two samples a pixel on, wider texels soften what is in focus.
    return sampleCounts(field).max <= 1 ? 1 : kMaxTexelsPerPixel;
}

float mapReach(const GridLayout& grid, float lensScale) {
    return glm::min(lensScale * largestSlope(grid), kMaxReachPx);
}

int mapRows(const Rect& frame, int texels, float reachPx, std::uint64_t bytes) {
    const double margin = 2 * (double(reachPx) + 3 * kMapAlignPx);
    const double rowTexels = (frame.width() + margin) * texels * texels * 4 / 3; // with all levels
    const double rowBytes = rowTexels * sizeof(glm::uvec4);
    const double rows = double(bytes) / rowBytes - margin;
    if (rows < kTileSize)
        throw Error(
            ErrorCode::resources,
            fmt::format("the memory budget is too small for a picture {} pixels wide with blur of {:.0f} "
                        "pixels: for its layer map it has to be {:.0f} MiB",
                        frame.width(), reachPx, 2 * rowBytes * (kTileSize + margin) / (1 << 20) + 1));
    return int(std::min(rows, double(frame.height() + kTileSize)));
}

MapLayout chooseMap(const GridLayout& grid, const Rect& region, int texels, float reachPx,
                    float spreadPerPx) {
    const float margin = reachPx + float(2 * kMapAlignPx); // tiles beyond the region, the coarsest texels
    const vec2 extent = vec2(grid.brickCount * grid.cellsPerBrick) / grid.invCell;
    const vec2 low = glm::max(vec2(float(region.x0), float(region.y0)) - margin, grid.origin);
    const vec2 high = glm::min(vec2(float(region.x1), float(region.y1)) + margin, grid.origin + extent);
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
    for (float spacing = float(texels) * spreadPerPx * largestSlope(grid);
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

vec2 texelCenter(const MapLayout& map, ivec2 texel) {
    return vec2(map.origin) + (vec2(texel) + 0.5f) * (1.f / float(map.texelsPerPixel));
}

namespace {

/// The layers of the samples within `searchRadius`.
MapTexel resolveWithin(const SearchContext& context, const MapLayout& map, ivec2 place, float searchRadius) {
    const GridLayout& grid = context.bins.grid;
    const float radius = map.tentPx;
    const float widening = radius / grid.radiusPx;
    const float fullWeight = kFullWeight * widening * widening;
    MapTexel texel;
    Surface surface;
    const float maxRadiusRatio = radius * float(map.texelsPerPixel);
    const auto visit = [&](Candidate candidate) {
        if (surface.count > 0 && candidate.slope > surface.slopeMax + grid.surfaceGap) {
            close(texel, surface, fullWeight, false);
            surface = Surface{};
            if (texel.count == kMapLayers) return false;
        }
        // Where own radii are less than the tent's, there are more samples in it than it takes.
        const float widened = glm::min(candidate.value.w, maxRadiusRatio) / candidate.value.w;
        candidate.weight *= widened * widened;
        addSample(surface, candidate, radius);
        return true;
    };
    forEachCandidate(context, Output{texelCenter(map, place), vec2(0), 0, 0}, searchRadius, maxRadiusRatio,
                     visit, [](const Brick&) { return false; });
    if (surface.count > 0) close(texel, surface, fullWeight, true);
    return texel;
}

} // namespace

MapTexel resolveTexel(const SearchContext& context, const MapLayout& map, ivec2 texel) {
    const MapTexel found = resolveWithin(context, map, texel, map.tentPx);
    return found.count > 1 ? resolveWithin(context, map, texel, 2 * map.tentPx) : found;
}

namespace {

/// The layers of the four texels below one, those that are there.
using Children = std::array<MapLayer, 4 * kMapLayers>;

float leastAbove(const Children& children, float slope) {
    float least = kNoLayer;
    for (const MapLayer& child : children)
        if (child.slope > slope) least = glm::min(least, child.slope);
    return least;
}

/// The layers of all children within [begin, end] as one; false when there are none left.
bool nextLayer(const Children& children, float gap, float& begin, float& end) {
    begin = end = leastAbove(children, end);
    if (begin >= kNoLayer) return false;
    for (std::size_t i = 0; i < children.size(); ++i) {
        const float next = leastAbove(children, end);
        if (next > end + gap) break;
        end = next;
    }
    return true;
}

MapLayer merged(const Children& children, float begin, float end) {
    vec3 sum(0);
    float coverage = 0, slopeSum = 0;
    for (const MapLayer& child : children) {
        if (!(child.slope >= begin && child.slope <= end)) continue;
        sum += child.coverage * child.rgb;
        coverage += child.coverage;
        slopeSum += child.coverage * child.slope;
    }
    return {sum / coverage, glm::min(0.25f * coverage, 1.f), slopeSum / coverage};
}

MapTexel merge(const Children& children, float gap) {
    MapTexel texel;
    float begin = 0, end = -std::numeric_limits<float>::infinity();
    while (texel.count < kMapLayers && nextLayer(children, gap, begin, end))
        texel.layers[std::size_t(texel.count++)] = merged(children, begin, end);
    return texel;
}

} // namespace

void reduceLevel(LayerMap& map, int level) {
    const MapLayout& layout = map.layout;
    const ivec2 below = levelSize(layout, level - 1), size = levelSize(layout, level);
    const std::size_t source = levelBegin(layout, level - 1), target = levelBegin(layout, level);
    parallelFor(0, std::size_t(size.y), 8, [&](std::size_t first, std::size_t last) {
        for (int y = int(first); y < int(last); ++y)
            for (int x = 0; x < size.x; ++x) {
                Children children;
                for (std::size_t i = 0; i < 4; ++i) {
                    const std::size_t column = 2 * std::size_t(x) + i % 2, row = 2 * std::size_t(y) + i / 2;
                    const MapTexel child =
                        unpackTexel(map.texels[source + row * below.x + column], layout.code);
                    std::copy(child.layers.begin(), child.layers.end(), &children[i * kMapLayers]);
                }
                map.texels[target + std::size_t(y) * size.x + x] =
                    packTexel(merge(children, layout.surfaceGap), layout.code);
            }
    });
}

LayerMap makeLayerMap(const Bins& bins, const MapLayout& layout) {
    LayerMap map;
    map.layout = layout;
    map.texels.resize(levelBegin(layout, layout.levels));

    const OutputLayout tiles = mapTiles(layout);
    const LensBox center{vec2(0), vec2(0)};
    const TileLists lists = makeTileLists(bins, tiles, {&center, 1}, 2 * layout.tentPx);
    parallelFor(0, std::size_t(layout.size.y), 8, [&](std::size_t first, std::size_t last) {
        for (int y = int(first); y < int(last); ++y)
            for (int x = 0; x < layout.size.x; ++x) {
                const ivec2 tile = ivec2(x, y) / (kTileSize * layout.texelsPerPixel);
                const std::size_t list = std::size_t(tile.y) * tiles.tileCount.x + tile.x;
                const std::span<const uint> bricks(lists.bricks.data() + lists.start[list],
                                                   lists.start[list + 1] - lists.start[list]);
                map.texels[std::size_t(y) * layout.size.x + x] =
                    packTexel(resolveTexel({bins, bricks}, layout, ivec2(x, y)), layout.code);
            }
    });
    for (int level = 1; level < layout.levels; ++level) reduceLevel(map, level);
    return map;
}

} // namespace slant

#include "reconstruct/lens_tiles.h"

#include "base/parallel.h"
#include "reconstruct/kernels.h"
#include "reconstruct/plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>

namespace slant {
namespace {

/// Lens positions along one side of a group's part of the square, and places along one side of a tile.
constexpr int kLensSteps = 3, kTileSteps = 2;
/// The map is curved between the sampled places: bounds grow by this share of their span, and by one pixel.
constexpr float kBulge = 0.05f, kBulgePx = 1;

/// Along x and y.
struct Interval {
    vec2 low{kInfinity}, high{-kInfinity};

    void add(vec2 from, vec2 to) {
        low = glm::min(low, from);
        high = glm::max(high, to);
    }
};

/// The places of a tile as a group sees them, on the scene's side. Blocked ones count too, since only then
/// the map is smooth; none where the film is dark.
std::vector<Output> placesOf(const LensMap& lens, const OutputPattern& pattern, std::size_t group,
                             vec2 corner) {
    const LensBox& cells = pattern.cells[group];
    std::vector<Output> places;
    for (int i = 0; i < kLensSteps * kLensSteps; ++i) {
        const vec2 part = vec2(float(i % kLensSteps), float(i / kLensSteps)) / float(kLensSteps - 1);
        const vec2 uv = pattern.aperture.at(glm::mix(cells.min, cells.max, part));
        for (int k = 0; k < kTileSteps * kTileSteps; ++k) {
            const vec2 step = vec2(float(k % kTileSteps), float(k / kTileSteps)) / float(kTileSteps - 1);
            Output output = outputOnFilm(corner + step * float(kTileSize), pattern.lensScale * uv, 0, 0);
            const SceneRay ray = lens.at(output.xy, output.uv);
            if (!(ray.openShare > 0)) continue;
            toSceneSide(output, ray);
            places.push_back(output);
        }
    }
    return places;
}

/// Slope of the k-th bounds.
float slopeAt(const GridLayout& grid, int k) {
    const float range = float(grid.bucketCount) / grid.invBucket;
    return grid.slopeMin + range * (float(k) / float(kLensTileSlopes - 1));
}

/// Where a tile looks at one slope.
Interval intervalOf(const std::vector<Output>& places, float slope, float marginPx) {
    Interval seen;
    for (const Output& output : places) {
        const vec2 p = pinholeOf(output.xy, output.uv, slope), margin = (marginPx + kBulgePx) * output.extent;
        seen.add(p - margin, p + margin);
    }
    const vec2 bulge = kBulge * glm::max(seen.high - seen.low, vec2(0));
    return {seen.low - bulge, seen.high + bulge};
}

/// The least and the greatest length on the film of a way of one pixel on the scene's side.
vec2 scalesOf(vec3 filmMetric) {
    const float mean = 0.5f * (filmMetric.x + filmMetric.z), half = 0.5f * (filmMetric.x - filmMetric.z);
    const float apart = std::sqrt(half * half + filmMetric.y * filmMetric.y);
    return {mean - apart, mean + apart};
}

/// Where a tile looks from, and through what of the pupil.
std::array<vec4, kListBoxTexels> boxesOf(const std::vector<Output>& places, float marginPx) {
    Interval seen = intervalOf(places, 0, marginPx), lens;
    for (const Output& output : places) lens.add(output.uv, output.uv);
    const vec2 bulge = kBulge * glm::max(lens.high - lens.low, vec2(0));
    return {vec4(seen.low, seen.high), vec4(lens.low - bulge, lens.high + bulge)};
}

LensSight sightOf(const LensMap& lens, const std::vector<Output>& places) {
    if (places.empty()) return {};
    Interval seen;
    vec2 scales(kInfinity, 0);
    float farthest = 0;
    for (const Output& output : places) {
        const vec2 here = scalesOf(output.filmMetric);
        scales = {std::min(scales.x, here.x), std::max(scales.y, here.y)};
        seen.add(output.uv, output.uv);
        farthest = std::max(farthest, glm::length(output.uv));
    }
    // Places on a stop differ in the light that they let through, so none stands for others.
    const vec2 extent = seen.high - seen.low;
    const float width = lens.ofStop() ? kInfinity : scales.y * std::max(extent.x, extent.y);
    return {farthest, scales.y * farthest, width, scales.x};
}

void ascend(float* low, float* high, int count) {
    for (int i = count - 2; i >= 0; --i) low[i] = std::min(low[i], low[i + 1]);
    for (int i = 1; i < count; ++i) high[i] = std::max(high[i], high[i - 1]);
}

} // namespace

LensTiles lensTilesOf(const LensMap& lens, const OutputPattern& pattern, std::size_t firstGroup,
                      std::size_t groupCount, const GridLayout& grid, const OutputLayout& layout,
                      float marginPx) {
    const int columns = layout.tileCount.x, rows = layout.tileCount.y;
    const std::size_t block = 2 * std::size_t(columns + rows);
    LensTiles tiles{std::vector<float>(groupCount * kLensTileSlopes * block),
                    std::vector<vec4>(kListBoxTexels * groupCount * std::size_t(columns) * std::size_t(rows)),
                    std::vector<LensSight>(groupCount * std::size_t(columns) * std::size_t(rows))};
    parallelFor(0, groupCount, 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t group = first; group < last; ++group) {
            const auto at = [&](int slope) {
                return tiles.bounds.data() + (group * kLensTileSlopes + std::size_t(slope)) * block;
            };
            for (int k = 0; k < kLensTileSlopes; ++k) {
                std::fill_n(at(k), columns, kFarPx);
                std::fill_n(at(k) + columns, columns, -kFarPx);
                std::fill_n(at(k) + 2 * columns, rows, kFarPx);
                std::fill_n(at(k) + 2 * columns + rows, rows, -kFarPx);
            }
            for (int y = 0; y < rows; ++y)
                for (int x = 0; x < columns; ++x) {
                    const vec2 corner(layout.regionOrigin + kTileSize * ivec2(x, y));
                    const std::vector<Output> places = placesOf(lens, pattern, firstGroup + group, corner);
                    const std::size_t list =
                        (group * std::size_t(rows) + std::size_t(y)) * std::size_t(columns) + std::size_t(x);
                    tiles.sights[list] = sightOf(lens, places);
                    std::ranges::copy(boxesOf(places, marginPx),
                                      tiles.boxes.begin() + std::ptrdiff_t(kListBoxTexels * list));
                    for (int k = 0; k < kLensTileSlopes; ++k) {
                        const Interval seen = intervalOf(places, slopeAt(grid, k), marginPx);
                        float *column = at(k) + x, *row = at(k) + 2 * columns + y;
                        column[0] = std::min(column[0], seen.low.x);
                        column[columns] = std::max(column[columns], seen.high.x);
                        row[0] = std::min(row[0], seen.low.y);
                        row[rows] = std::max(row[rows], seen.high.y);
                    }
                }
            for (int k = 0; k < kLensTileSlopes; ++k) {
                ascend(at(k), at(k) + columns, columns);
                ascend(at(k) + 2 * columns, at(k) + 2 * columns + rows, rows);
            }
        }
    });
    return tiles;
}

namespace {

struct LensTileKernels {
    const float* bounds;

    float lensTileBoundAt(int i) const { return bounds[i]; }
#include "lib/lens_tiles.glsl"
};

SweptBrick sweptAt(const Bins& bins, uint brick, vec2 times) {
    SweptBrick swept = sweptBrick(bins.bricks[brick], bins.grid);
    if (bins.motion.moves()) sweepOver(swept, bins.brickMotions[brick], times, bins.motion.layout.c2);
    return swept;
}

} // namespace

TileRange tilesOfCompoundLens(const Bins& bins, uint brick, const OutputLayout& layout,
                              std::span<const float> bounds, std::size_t group, vec2 times) {
    const ivec4 tiles = LensTileKernels{bounds.data()}.tilesOfCompoundLens(sweptAt(bins, brick, times),
                                                                           bins.grid, layout, int(group));
    return {ivec2(tiles.x, tiles.y), ivec2(tiles.z, tiles.w)};
}

bool listSees(const Bins& bins, uint brick, const LensTiles& tiles, std::size_t list, vec2 times) {
    const vec4* box = tiles.boxes.data() + kListBoxTexels * list;
    return isSeen(sweptAt(bins, brick, times), box[0], box[1]);
}

Rect searchRegionOf(const SceneSideSamples& source, const FilterTable& filter) {
    const LightField& field = source.field();
    const std::span<const LightFieldSample> samples = source.samples();
    const Rect region = outputRegion(field.frame, filter);
    if (field.lensMap.empty()) return region;
    const float marginPx = widestSearchPx(densityOf(source));
    const OutputPattern whole = makeOutputPattern(1, 0);
    Interval seen;
    float farthest = 1, widest = 1; // from the pupil's centre; pixels of the scene's side to one of the film
    for (int y = region.y0; y < region.y1; y += kTileSize)
        for (int x = region.x0; x < region.x1; x += kTileSize)
            for (const Output& output : placesOf(field.lensMap, whole, 0, vec2(float(x), float(y)))) {
                seen.add(output.xy, output.xy);
                farthest = std::max(farthest, glm::length(output.uv));
                widest = std::max({widest, output.extent.x, output.extent.y});
            }
    if (!(seen.low.x <= seen.high.x)) return region; // all dark
    float slope = 0;
    std::mutex mutex;
    parallelFor(0, samples.size(), 1 << 15, [&](std::size_t first, std::size_t last) {
        float local = 0;
        for (std::size_t i = first; i < last; ++i)
            if (std::isfinite(samples[i].slope)) local = std::max(local, std::abs(samples[i].slope));
        const std::lock_guard lock(mutex);
        slope = std::max(slope, local);
    });
    const vec2 span = seen.high - seen.low;
    const float more = marginPx * (widest - 1) + slope * (farthest - 1) + kBulge * glm::max(span.x, span.y);
    const vec2 low = glm::max(glm::floor(seen.low - more), -kFarPx),
               high = glm::min(glm::ceil(seen.high + more), kFarPx);
    return {int(low.x), int(low.y), int(high.x), int(high.y)};
}

} // namespace slant

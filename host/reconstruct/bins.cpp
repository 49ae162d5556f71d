#include "reconstruct/bins.h"

#include <algorithm>

namespace slant {
namespace {

/// Where a sample is binned. As lib/grid.glsl.
struct Place {
    uint brickKey; ///< (bucket, row, column) of its brick in the dense table
    uint cell;     ///< within the brick
};

Place placeOf(const GridLayout& grid, vec2 p, float slope) {
    const ivec2 cells = grid.brickCount * grid.cellsPerBrick;
    const ivec2 cell = glm::clamp(ivec2(glm::floor((p - grid.origin) * grid.invCell)), ivec2(0), cells - 1);
    const ivec2 brick = cell / grid.cellsPerBrick;
    const ivec2 inside = cell - brick * grid.cellsPerBrick;
    const int bucket = glm::clamp(int((slope - grid.slopeMin) * grid.invBucket), 0, grid.bucketCount - 1);
    return {uint((bucket * grid.brickCount.y + brick.y) * grid.brickCount.x + brick.x),
            uint(inside.y * grid.cellsPerBrick + inside.x)};
}

Brick brickAt(const GridLayout& grid, uint key) {
    const int column = int(key) % grid.brickCount.x;
    const int row = int(key) / grid.brickCount.x % grid.brickCount.y;
    return {column * grid.cellsPerBrick, row * grid.cellsPerBrick, 3.4e38f, -3.4e38f};
}

} // namespace

Bins binSamples(const LightField& field, const Rect& region, float marginPx) {
    Bins bins;
    bins.grid = chooseGrid(field, region, marginPx);
    const GridLayout& grid = bins.grid;
    const std::size_t tableSize = std::size_t(grid.brickCount.x) * grid.brickCount.y * grid.bucketCount;

    std::vector<Place> places(field.samples.size());
    std::vector<uint> brickOfKey(tableSize, kNoBrick);
    for (std::size_t i = 0; i < places.size(); ++i) {
        const LightFieldSample& s = field.samples[i];
        places[i] =
            reaches(s, region, marginPx) ? placeOf(grid, pinholePosition(s), s.slope) : Place{kNoBrick, 0};
        if (places[i].brickKey != kNoBrick) brickOfKey[places[i].brickKey] = 0;
    }
    for (std::size_t key = 0; key < tableSize; ++key)
        if (brickOfKey[key] != kNoBrick) {
            brickOfKey[key] = uint(bins.bricks.size());
            bins.bricks.push_back(brickAt(grid, uint(key)));
        }

    const std::size_t cellsPerBrick = std::size_t(grid.cellsPerBrick) * grid.cellsPerBrick;
    bins.cellStart.assign(bins.bricks.size() * cellsPerBrick + 1, 0);
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (places[i].brickKey == kNoBrick) continue;
        const uint id = brickOfKey[places[i].brickKey];
        Brick& brick = bins.bricks[id];
        brick.slopeMin = std::min(brick.slopeMin, field.samples[i].slope);
        brick.slopeMax = std::max(brick.slopeMax, field.samples[i].slope);
        places[i].cell += uint(id * cellsPerBrick);
        ++bins.cellStart[places[i].cell + 1];
    }
    for (std::size_t cell = 1; cell < bins.cellStart.size(); ++cell)
        bins.cellStart[cell] += bins.cellStart[cell - 1];

    bins.positions.resize(bins.cellStart.back());
    bins.radiances.resize(bins.cellStart.back());
    std::vector<uint> next(bins.cellStart.begin(), bins.cellStart.end() - 1);
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (places[i].brickKey == kNoBrick) continue;
        const LightFieldSample& s = field.samples[i];
        const uint record = next[places[i].cell]++;
        bins.positions[record] = vec4(pinholePosition(s), s.slope, 0);
        bins.radiances[record] = vec4(s.r, s.g, s.b, s.alpha);
    }
    return bins;
}

} // namespace slant

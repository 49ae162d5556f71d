// The samples around an output, brick by brick: what every search of the bins is made of. As
// shaders/lib/search.glsl.
#pragma once
#include "reconstruct/tile_lists.h"

namespace slant {

/// Bricks to look at for one output.
struct SearchContext {
    const Bins& bins;
    std::span<const uint> bricks;
};

/// A sample seen from the output's lens position.
struct Candidate {
    vec2 offset;     ///< from the output, pixels of the film
    float distance2; ///< as if its own radius were that of the search
    float slope;
    float weight; ///< see visibilityWeight
    vec4 value;   ///< rgb; R over its own radius
};

inline ivec2 cellAt(const GridLayout& grid, vec2 place) {
    const ivec2 cells = grid.brickCount * grid.cellsPerBrick;
    return ivec2(glm::clamp(glm::floor(place), vec2(0), vec2(cells - 1)));
}

/// Calls visit for the samples that reproject to within `radius` of the output, or less for those whose own
/// radius is less than R: down to 1 / maxRadiusRatio of it. They come in the order of their bricks: front to
/// back, up to the width of a bucket; until visit returns false or hides(brick) says that what was met so far
/// hides a brick and all that follow. Returns loop steps.
template <typename Visit, typename Hides>
int forEachCandidate(const SearchContext& context, const Output& output, float radius, float maxRadiusRatio,
                     Visit&& visit, Hides&& hides) {
    const GridLayout& grid = context.bins.grid;
    const int side = grid.cellsPerBrick;
    // In cells: where the output lies, how far its window moves with slope, and its half width.
    const vec2 center = (output.xy - grid.origin) * grid.invCell, shear = output.uv * grid.invCell;
    int iterations = 0;
    for (const uint id : context.bricks) {
        const Brick& brick = context.bins.bricks[id];
        const float ownRadius = radius * glm::max(widestRadius(brick), 1.f / maxRadiusRatio);
        const vec2 reach = ownRadius * grid.invCell * output.extent;
        const vec2 a = brick.slopeMin * shear, b = brick.slopeMax * shear;
        const ivec2 first = glm::max(cellAt(grid, center - glm::max(a, b) - reach), firstCell(brick));
        const ivec2 last = glm::min(cellAt(grid, center - glm::min(a, b) + reach), lastCell(brick));
        ++iterations;
        if (hides(brick)) return iterations;
        if (first.x > last.x || first.y > last.y) continue;
        const ivec2 corner = first / side * side;
        for (int row = first.y; row <= last.y; ++row) {
            const std::size_t cell = (std::size_t(id) * side + (row - corner.y)) * side - corner.x;
            const uint begin = context.bins.cellStart[cell + first.x];
            const uint end = context.bins.cellStart[cell + last.x + 1];
            iterations += int(end - begin) + 1;
            for (uint record = begin; record < end; ++record) {
                const vec4& position = context.bins.positions[record];
                vec2 offset = vec2(position.x, position.y) + position.z * output.uv - output.xy;
                if (output.compoundLens) offset = onFilm(output, offset);
                const float distance2 = offset.x * offset.x + offset.y * offset.y;
                if (!(distance2 < ownRadius * ownRadius)) continue;
                const vec4& value = context.bins.values[record];
                const float radiusRatio = glm::min(value.w, maxRadiusRatio);
                const float scaled2 = distance2 * (radiusRatio * radiusRatio);
                if (scaled2 < radius * radius &&
                    !visit(Candidate{offset, scaled2, position.z, position.w, value}))
                    return iterations;
            }
        }
    }
    return iterations;
}

} // namespace slant

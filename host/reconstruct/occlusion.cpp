#include "reconstruct/occlusion.h"

#include "base/parallel.h"
#include "reconstruct/hash.h"

#include <algorithm>
#include <bit>

namespace slant {
namespace {

/// Blocks of 1 or 2 px and closer planes lower the error by a few percent only.
constexpr float kMinBlockPx = 4, kMinSpacingPx = 1;
constexpr int kMaxPlanes = 128;
/// Of all planes, 128 MiB; larger pictures have larger blocks.
constexpr double kMaxBlocks = 1 << 25;
constexpr int kRaysPerPixel = 8;

/// One ray in `stride`, chosen by its place, so that the order of samples does not matter.
bool isFollowed(const OcclusionLayout& layout, vec2 xy) {
    return hash(std::bit_cast<uint>(xy.x) ^ hash(std::bit_cast<uint>(xy.y))) % layout.stride == 0;
}

/// The first plane that lies behind a sample's surface.
int firstPlaneBehind(const OcclusionLayout& layout, float slope, float surfaceGap) {
    const float steps = glm::floor((slope + surfaceGap - layout.slopeMin) / layout.spacing) + 1.f;
    return int(glm::clamp(steps, 0.f, float(layout.planeCount)));
}

float planeSlope(const OcclusionLayout& layout, int plane) {
    return layout.slopeMin + (float(plane) + 0.5f) * layout.spacing;
}

/// The block of a plane that a ray crosses at p, and -1 where it crosses none.
int blockCrossed(const OcclusionLayout& layout, int plane, vec2 p, vec2 origin) {
    const vec2 place = glm::floor((p - origin) * layout.invBlock);
    const ivec2 blocks = layout.blockCount;
    if (place.x < 0 || place.y < 0 || place.x >= float(blocks.x) || place.y >= float(blocks.y)) return -1;
    return (plane * blocks.y + int(place.y)) * blocks.x + int(place.x);
}

/// The block that a sample lies in.
int blockOf(const OcclusionLayout& layout, vec2 p, float slope, vec2 origin) {
    const vec2 place = glm::floor((p - origin) * layout.invBlock);
    const ivec2 block = ivec2(glm::clamp(place, vec2(0), vec2(layout.blockCount - 1)));
    const float steps = glm::floor((slope - layout.slopeMin) / layout.spacing);
    const int plane = int(glm::clamp(steps, 0.f, float(layout.planeCount - 1)));
    return (plane * layout.blockCount.y + block.y) * layout.blockCount.x + block.x;
}

} // namespace

OcclusionLayout chooseOcclusion(const GridLayout& grid, const SampleDensity& density) {
    const float slopes = float(grid.bucketCount) / grid.invBucket;
    const vec2 extent = vec2(grid.brickCount * grid.cellsPerBrick) / grid.invCell;
    OcclusionLayout layout;
    layout.slopeMin = grid.slopeMin;
    layout.spacing = std::max({kMinSpacingPx, grid.surfaceGap, slopes / float(kMaxPlanes - 1)});
    layout.planeCount = int(slopes / layout.spacing) + 1;
    layout.stride = uint(std::max(1, int(density.typical) / kRaysPerPixel));
    float blockPx = kMinBlockPx;
    const auto blocks = [&] { return glm::floor(extent / blockPx) + 1.f; };
    while (double(layout.planeCount) * blocks().x * blocks().y > kMaxBlocks) blockPx *= 2;
    layout.blockCount = ivec2(blocks());
    layout.invBlock = 1 / blockPx;
    layout.raysPerBlock = density.least / float(layout.stride) * blockPx * blockPx;
    return layout;
}

std::vector<uint> countStopped(std::span<const LightFieldSample> samples, const GridLayout& grid,
                               const OcclusionLayout& layout) {
    std::vector<uint> stopped(stoppedBlocks(layout));
    // Each thread has planes of its own, so that counts need no atomics.
    parallelFor(0, std::size_t(layout.planeCount), 16, [&](std::size_t first, std::size_t last) {
        for (const LightFieldSample& s : samples) {
            if (!isFollowed(layout, vec2(s.x, s.y)) || !(glm::abs(s.slope) < kFarPx))
                continue; // disabled ones are far
            int plane = std::max(int(first), firstPlaneBehind(layout, s.slope, grid.surfaceGap));
            for (; plane < int(last); ++plane) {
                const vec2 p = vec2(s.x, s.y) - planeSlope(layout, plane) * vec2(s.u, s.v);
                const int block = blockCrossed(layout, plane, p, grid.origin);
                if (block >= 0) ++stopped[block];
            }
        }
    });
    return stopped;
}

float visibilityWeight(std::span<const uint> stopped, const GridLayout& grid, const OcclusionLayout& layout,
                       vec2 p, float slope, float radiusRatio) {
    const uint count = stopped[blockOf(layout, p, slope, grid.origin)];
    const float rays = layout.raysPerBlock * (radiusRatio * radiusRatio);
    return 1.f / glm::max(1.f - float(count) / rays, kMinVisible);
}

} // namespace slant

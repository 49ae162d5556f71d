#include "reconstruct/occlusion.h"

#include "base/parallel.h"
#include "reconstruct/points.h"

#include <algorithm>

namespace slant {
namespace {

/// Blocks of 1 or 2 px and closer planes lower the error by a few percent only.
constexpr float kMinBlockPx = 4, kMinSpacingPx = 1;
constexpr int kMaxPlanes = 128;
/// Limit for all planes, 128 MiB; larger pictures have larger blocks.
constexpr double kMaxBlocks = 1 << 25;
constexpr int kRaysPerPixel = 8;
/// What moves stays within about two blocks for the time of a slot, and a slot has a few rays of every
/// pixel's.
constexpr float kSlotPx = 8;
constexpr float kMaxSlots = 8;

} // namespace

OcclusionLayout chooseOcclusion(const GridLayout& grid, const SampleDensity& density, MotionGrid& motion) {
    const bool moves = motion.moves();
    MotionLayout& ranks = motion.layout;
    if (moves) ranks.timeSlots = std::clamp(std::ceil(motion.fastestPx() / kSlotPx), 1.f, kMaxSlots);
    const float slots = moves ? ranks.timeSlots : 1;
    const float slopes = moves ? ranks.rankCount / ranks.invRank : float(grid.bucketCount) / grid.invBucket;
    const vec2 extent = vec2(grid.brickCount * grid.cellsPerBrick) / grid.invCell;
    OcclusionLayout layout;
    layout.slopeMin = moves ? ranks.rankMin : grid.slopeMin;
    layout.spacing = std::max({kMinSpacingPx, grid.surfaceGap, slopes / float(kMaxPlanes - 1)});
    layout.planeCount = int(slopes / layout.spacing) + 1;
    layout.stride = uint(std::max(1, int(density.typical) / kRaysPerPixel));
    float blockPx = kMinBlockPx;
    const auto blocks = [&] { return glm::floor(extent / blockPx) + 1.f; };
    while (double(slots) * layout.planeCount * blocks().x * blocks().y > kMaxBlocks) blockPx *= 2;
    layout.blockCount = ivec2(blocks());
    layout.invBlock = 1 / blockPx;
    layout.raysPerBlock = density.least / float(layout.stride) * blockPx * blockPx / slots;
    return layout;
}

std::vector<uint> countStopped(const SceneSideSamples& source, const GridLayout& grid,
                               const OcclusionLayout& layout, const MotionGrid& motion) {
    const Points points(source);
    std::vector<uint> stopped(stoppedBlocks(layout, motion));
    // Each thread has planes of its own, so that counts need no atomics.
    parallelFor(0, std::size_t(layout.planeCount), 16, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = 0; i < points.size(); ++i) {
            const LightFieldSample& s = points.sample(i);
            if (!isFollowed(layout, vec2(s.x, s.y)) || !(glm::abs(s.slope) < kFarPx))
                continue; // disabled ones are far
            const float rank = points.move() ? rankOf(motion.layout, s.slope, points.nearness(i)) : s.slope;
            const int slot = points.move() ? slotAt(motion.layout, s.t) * blocksPerSlot(layout) : 0;
            int plane = std::max(int(first), firstPlaneBehind(layout, rank, grid.surfaceGap));
            for (; plane < int(last); ++plane) {
                const float slope =
                    points.move() ? slopeOfPlane(layout, motion.layout, plane) : planeSlope(layout, plane);
                const vec2 p = pinholeOf(vec2(s.x, s.y), vec2(s.u, s.v), slope);
                const int block = blockCrossed(layout, plane, p, grid.origin);
                if (block >= 0) ++stopped[std::size_t(slot + block)];
            }
        }
    });
    return stopped;
}

float visibilityWeight(std::span<const uint> stopped, const GridLayout& grid, const OcclusionLayout& layout,
                       vec2 p, float slope, float radiusRatio) {
    return visibilityWeight(layout, stopped[std::size_t(blockOf(layout, p, slope, grid.origin))],
                            radiusRatio);
}

} // namespace slant

// From how much of the lens each binned sample is visible.
//
// A surface that lies partly behind another has fewer samples per square pixel than the pattern, though it is
// as solid as any. So coverage is not the number of samples but the ratio of samples to the rays that get as
// far: the rays that would cross a plane of the sample's slope near it, less those that end before it. They
// are counted for planes of slope and blocks of pinhole position, over a few rays per pixel. Where things
// move the planes are of rank (MotionLayout), and each slot of time counts its own rays: a sample is visible
// as much as on average along its way.
#pragma once
#include "reconstruct/motion_grid.h"

#include <span>
#include <vector>

namespace slant {

/// Planes over the slopes, or ranks, of the grid: as many as separate its surfaces, up to about a hundred.
/// Sets the slots of time of `motion`.
OcclusionLayout chooseOcclusion(const GridLayout& grid, const SampleDensity& density, MotionGrid& motion);

/// Blocks of all planes and slots.
inline std::size_t stoppedBlocks(const OcclusionLayout& layout, const MotionGrid& motion) {
    const std::size_t slots = motion.moves() ? std::size_t(motion.layout.timeSlots) : 1;
    return slots * layout.planeCount * layout.blockCount.y * layout.blockCount.x;
}

/// Rays that end before each block: [slot][plane][row][column]. Same as bin_occlude.comp.
std::vector<uint> countStopped(const SceneSideSamples& samples, const GridLayout& grid,
                               const OcclusionLayout& layout, const MotionGrid& motion);

/// 1 / (part of the lens from which a sample at pinhole position p is visible), at most 1 / kMinVisible;
/// `radiusRatio` as radiusRatioAt.
float visibilityWeight(std::span<const uint> stopped, const GridLayout& grid, const OcclusionLayout& layout,
                       vec2 p, float slope, float radiusRatio);

} // namespace slant

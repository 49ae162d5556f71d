// What the grid of a field that moves has beyond that of a still one: the layers that its bricks are cut
// into.
//
// Where nothing moves a brick holds a bucket of slopes. Here it holds one class of velocities within a bucket
// of ranks: so its bounds are tight, and where things pass each other at nearly the same depth, each has
// bricks of its own, which can be put front to back (brick_order.h). The classes that occur are numbered;
// those are the layers.
#pragma once
#include "reconstruct/grid.h"

namespace slant {

struct MotionGrid {
    MotionLayout layout{};    ///< with the traced shutter
    std::vector<uint> layers; ///< of each class (lib/motion.glsl); empty where nothing moves
    uint layerCount = 0;
    bool changesDepth = false; ///< anything's depth changes, and with it what is in front of what

    bool moves() const { return !layers.empty(); }
    /// Pixels per shutter, along x or y, of what moves fastest; 0 where nothing moves.
    float fastestPx() const;
};

/// Layers for the samples that `grid` has binned. Nothing for a field that does not move.
MotionGrid chooseMotionGrid(const SceneSideSamples& samples, const GridLayout& grid,
                            const SampleDensity& density, const BinScope& scope);

} // namespace slant

// What a search of the bins looks at (shaders/lib/search.glsl).
#pragma once
#include "reconstruct/tile_lists.h"

namespace slant {

/// Bricks to look at for one output.
struct SearchContext {
    const Bins& bins;
    std::span<const uint> bricks;
};

} // namespace slant

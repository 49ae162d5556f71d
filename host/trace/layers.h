// A coat over a metal, as pbrt-v4's coated conductor has it: an interface, an absorbing gap, and a base.
#pragma once

namespace slant {

struct Layers {
    float eta = 1.5f;        ///< index of the coat
    float thickness = 0.01f; ///< of the gap: each crossing leaves exp(-thickness / |cos|)
    int maxDepth = 10;       ///< vertices of a walk between the two
};

} // namespace slant

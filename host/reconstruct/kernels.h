// The kernels that CPU and compute path share (shaders/lib/), as C++. For source files only: it brings GLSL's
// functions into the namespace. Kernels that fetch are included where they are needed, in structs that fetch
// for them.
#pragma once
#include "lightfield/lightfield.h"

#include "lib/gaussian.glsl"
#include "lib/grid.glsl"
#include "lib/map_texel.glsl"
#include "lib/motion.glsl"
#include "lib/occlusion.glsl"
#include "lib/output.glsl"
#include "lib/surface.glsl"
#include "lib/trajectory.glsl"

namespace slant {

inline Trajectory trajectoryOf(const LightFieldSample& s) {
    return trajectoryOf(vec2(s.x, s.y), vec2(s.u, s.v), s.slope);
}
inline vec2 pinholePosition(const LightFieldSample& s) {
    return trajectoryOf(s).pinhole;
}

} // namespace slant

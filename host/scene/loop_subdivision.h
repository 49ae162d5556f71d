// Loop's subdivision surfaces as triangle meshes.
#pragma once
#include "scene/scene.h"

namespace slant {

/// The triangles of `control` cut in four `levels` times by Loop's rules (1987, with Warren's weights;
/// boundaries are cubic B-splines), then put where further cuts would end, with the normals there; as in
/// pbrt, against the order of a triangle's corners. Throws Error(badInput) at `where` for edges of more than
/// two triangles, of two that are not turned alike, and for triangles that meet in a corner alone.
Mesh loopSubdivided(const Mesh& control, int levels, const FileLocation& where);

} // namespace slant

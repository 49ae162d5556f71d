// Where mirrors and glass show what a camera ray sees through them: the depth at which a point would have to
// lie, without them, to be seen through all of the lens as this one is.
//
// A ray goes on as most of its light does, mirrored or refracted, until it meets something that scatters
// otherwise. Neighbouring rays go through the same surfaces: some leave the lens beside the ray, some in
// other directions. What a shift on the lens moves at the end, A, and what a change of direction moves there,
// B, are two by two matrices. Rays that turn around a point at depth w are shifted by -w times what their
// direction changes, so that A = B / w without mirrors; in a flat mirror w is the length of the way. In a
// curved one, or through a lens, rays along the two axes cross at two depths, and the mean of 1 / w is taken:
// the slope is linear in that.
#pragma once
#include "trace/geometry.h"
#include "trace/materials.h"

namespace slant {

/// The camera as neighbouring rays need it.
struct LensAxes {
    glm::dvec3 right, down; ///< world space, of unit length in camera space
    double radius;          ///< in camera space, above 0
};

/// The depth of the image that `cameraRay` sees where it meets `hit`, at most some hundred times that of
/// `hit`; that of `hit` if the surface scatters. The chain ends where neighbouring rays leave it, or don't
/// meet again.
float imageDepth(const Geometry& geometry, const Materials& materials, const Ray& cameraRay,
                 const SurfaceHit& hit, const LensAxes& axes);

} // namespace slant

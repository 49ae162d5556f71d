// Layout of a lens map (host/camera/lens_map.h) in a buffer of texels, for C++ and GLSL.
#ifndef SLANT_SHARED_LENS_MAP_H
#define SLANT_SHARED_LENS_MAP_H
#include "shared/types.h"

SLANT_SHARED_BEGIN

/// Texel 0: film centre x, y; radii a pixel; number of radii. Texel 1: rings a pixel; number of rings; turns
/// of half a circle; distances (intervals). Then come the radii, [radius]: distance from the centre at which
/// the middle of the pupil looks on the focus plane; how much longer a short way there is than on the film,
/// along and across the radius; irradiance. Then the nodes, [ring][turn][distance]: aberration along and
/// across the radius, in pixels of the film; place on the entrance pupil, along and across.
SLANT_SHARED_CONSTANT int kLensMapHeader = 2;

SLANT_SHARED_END

#endif

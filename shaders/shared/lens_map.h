// Layout of a lens map (host/camera/lens_map.h) in a buffer of texels, for C++ and GLSL.
#ifndef SLANT_SHARED_LENS_MAP_H
#define SLANT_SHARED_LENS_MAP_H
#include "shared/types.h"

SLANT_SHARED_BEGIN

/// Texel 0: film centre x, y; radii per pixel; number of radii. Texel 1: rings per pixel; number of rings;
/// turns per half circle; distances (intervals). Texel 2: 0, or 1 if the unit disc is that of the stop; then
/// three zeros. Then come the radii, [radius]: distance from the centre at which the middle of the pupil
/// looks on the focus plane; how much longer a short way there is than on the film, along and across the
/// radius; irradiance. Then the nodes, [ring][turn][distance]: aberration along and across the radius, in
/// pixels of the film; place on the entrance pupil, along and across. If the disc is that of the stop, then
/// come the lights, in the same order: irradiance by this place; clearance, below 0 where rays are blocked;
/// the share of the disc that is open for this ring; 0.
SLANT_SHARED_CONSTANT int kLensMapHeader = 3;

/// Texels of host/camera/lens_distortion.h. Texel 0: film centre x, y; the distance h from the centre on the
/// scene's side, pixels, at half of the ratios; the number n of the last. Then the ratios, i of n at distance
/// h i / (n - i): film radius over that; how much greater the next one is; 0, 0.

/// What the map has of a ray, whether there is light or not.
struct LensNode {
    vec4 node;  // as of its nodes
    vec4 light; // as of its lights, if the disc is that of the stop
};

/// A ray on the scene's side.
struct SceneRay {
    vec2 xy; // on the plane in focus, pixels
    vec2 uv; // on the entrance pupil's plane, radii
    /// Symmetric matrix (xx, xy, yy) that turns a short way there into one on the film.
    vec3 filmMetric;
    vec2 extent;     // half the size of a box around all that is within a pixel of the film
    float weight;    // irradiance of the film under radiance 1; 0: dark, no ray gets there
    float openShare; // of the disc, from which rays get there; 0: nothing else is set
};

SLANT_SHARED_END

#endif

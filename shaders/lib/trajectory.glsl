// Trajectories: where a point of the scene is seen from each place on the lens.
//
// A point that keeps still moves along a line as the eye moves over the lens: by its slope, pixels per lens
// radius. From the lens's centre it is seen at its pinhole position.
#ifndef SLANT_LIB_TRAJECTORY_GLSL
#define SLANT_LIB_TRAJECTORY_GLSL
#include "shared/kernel.h"

SLANT_SHARED_BEGIN

struct Trajectory {
    vec2 pinhole; // raster position
    float slope;
};

/// Where the ray from raster position xy through lens position uv meets a surface of that slope, as seen from
/// the lens's centre.
KERNEL vec2 pinholeOf(vec2 xy, vec2 uv, float slope) {
    return xy - slope * uv;
}

/// Of a sample.
KERNEL Trajectory trajectoryOf(vec2 xy, vec2 uv, float slope) {
    const Trajectory trajectory = {pinholeOf(xy, uv, slope), slope};
    return trajectory;
}

/// Raster position from a place on the lens.
KERNEL vec2 seenFrom(IN(Trajectory) trajectory, vec2 uv) {
    return trajectory.pinhole + trajectory.slope * uv;
}

/// Bounds of how far trajectories are seen from their pinhole positions.
struct Shift {
    vec2 low, high;
};

/// Of slopes from one to another, from one place on the lens.
KERNEL Shift shiftAt(vec2 uv, float slopeMin, float slopeMax) {
    const vec2 a = slopeMin * uv, b = slopeMax * uv;
    const Shift shift = {min(a, b), max(a, b)};
    return shift;
}

/// The same over a box of places.
KERNEL Shift shiftOver(vec2 uvMin, vec2 uvMax, float slopeMin, float slopeMax) {
    const vec2 a = slopeMin * uvMin, b = slopeMin * uvMax;
    const vec2 c = slopeMax * uvMin, d = slopeMax * uvMax;
    const Shift shift = {min(min(a, b), min(c, d)), max(max(a, b), max(c, d))};
    return shift;
}

SLANT_SHARED_END
#endif

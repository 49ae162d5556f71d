// What fields that move add to bins, lists and outputs (SampleSet::motion of host/lightfield/lightfield.h),
// for C++ and GLSL. Points are kept as they are in the middle of the traced shutter, which lasts from -1/2 to
// 1/2 of `time` here.
#ifndef SLANT_SHARED_MOTION_H
#define SLANT_SHARED_MOTION_H
#include "shared/types.h"

SLANT_SHARED_BEGIN

/// Of a field, its grid and the picture that is made. Floats alone, four texels.
struct MotionLayout {
    float c2;           // of SlopeModel, at the picture's focus: slope - c2 goes with 1/w
    float slopePerRank; // 0 for a pinhole
    float shutterOpen;  // of the picture
    float shutterSpan;
    /// The rank of a point is rankPerSlope (slope - c2), or -rankPerNearness / w where slopes tell nothing of
    /// depth: the nearer, the smaller. It is cut into buckets as slopes are where nothing moves.
    float rankPerSlope, rankPerNearness;
    float rankMin, invRank;
    vec2 velocityMin; // where the first class of velocities begins, pixels per shutter
    float invVelocity;
    float brickPx; // side of a brick
    vec2 velocityCount;
    float rankCount; // buckets and classes; those at the ends reach to infinity
    float timeSlots; // of OcclusionLayout's blocks
};
SLANT_SHARED_CONSTANT int kMotionTexels = 4;

/// Two surfaces this far apart in velocity, pixels per shutter, over surfaceGap, can hide each other: a
/// shutter is as long as half the lens is wide (Lehtinen et al. 2011 take half the step in time, too).
SLANT_SHARED_CONSTANT float kVelocityGap = 2.0f;

/// No rank is farther from 0.
SLANT_SHARED_CONSTANT float kFarRank = 1e30f;

/// Bounds of a brick's motions. That of a sample is, relative to `center` in pixels,
///     p(time) = center + (p - center + time * drift) / (1 + time * depthRate).
/// Two texels.
struct BrickMotion {
    vec2 low, high; // of drifts, pixels per shutter
    vec2 depthRate; // least, greatest
    vec2 center;
};
SLANT_SHARED_CONSTANT int kBrickMotionTexels = 2;

/// Of a sample before it is sorted: its motion; its rank, 0, 0, 0.
SLANT_SHARED_CONSTANT int kPlacedMotionTexels = 2;

/// Words of a brick's motion while its bounds are gathered, after kBoundWords: ordered bits of the least
/// drift, the complement of those of the greatest, of x and y; the same for depthRate and rank.
SLANT_SHARED_CONSTANT uint kMotionBoundWords = 8u;

/// Steps of the velocities that a layer of the map has, over those of all classes.
SLANT_SHARED_CONSTANT float kVelocitySteps = 65535.0f;

SLANT_SHARED_END

#endif

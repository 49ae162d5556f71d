// The front-most apparent surface within R of an output, tent-filtered, where it is the only one or its
// samples surround the output. Anything else needs lib/visibility.glsl.
//
// What lib/search.glsl needs of a sweep; with kMoving as there. In C++ it is included in a struct, after
// lib/candidate.glsl.
#include "lib/candidate.glsl"
#include "shared/reconstruct.h"

struct Sweep {
    bool running; // false: there is another surface behind
    float invRadius, surfaceGap;
    vec3 sum;
    float weightSum, slopeMax;
    Hull hull;
    VelocityBox velocities;
};

KERNEL Sweep newSweep(float radiusPx, float surfaceGap) {
    const Sweep sweep = {true, 1.0f / radiusPx, surfaceGap, vec3(0.0f),
                         0.0f, -kInfinity,      noHull(),   noVelocities()};
    return sweep;
}

KERNEL void visit(IN(Candidate) candidate, INOUT(Sweep) sweep) {
    bool parted = candidate.slope > sweep.slopeMax + sweep.surfaceGap;
    if (kMoving) {
        parted = parted || isApart(sweep.velocities, velocityOf(candidate), kVelocityGap * sweep.surfaceGap);
        addVelocity(sweep.velocities, velocityOf(candidate));
    }
    if (sweep.weightSum > 0.0f && parted) {
        sweep.running = false;
        return;
    }
    const float weight = candidate.weight * (1.0f - sqrt(candidate.distance2) * sweep.invRadius);
    sweep.sum += weight * vec3(candidate.value);
    sweep.weightSum += weight;
    sweep.slopeMax = max(sweep.slopeMax, candidate.slope);
    addPoint(sweep.hull, candidate.offset);
}

KERNEL bool isSolid(IN(Sweep) sweep) {
    return sweep.weightSum >= kSolidInner * kFullWeight && surrounds(sweep.hull);
}

KERNEL bool hides(IN(Sweep) sweep, IN(Brick) brick) {
    return brick.slopeMin > sweep.slopeMax + sweep.surfaceGap && isSolid(sweep);
}

/// Whether the output sees just the surface that was found.
KERNEL bool isTaken(IN(Sweep) sweep) {
    return sweep.running ? sweep.weightSum > 0.0f : isSolid(sweep);
}

KERNEL vec3 valueOf(IN(Sweep) sweep) {
    return sweep.sum / sweep.weightSum;
}

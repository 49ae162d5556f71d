// The samples within twice a base radius of an output, split into apparent surfaces that are composited over
// one another, front to back. One that surrounds the output hides the rest; any other covers in proportion
// to its number of samples; the last fills what remains.
//
// After Lehtinen et al. 2011, section 4, with two differences. Surfaces are split at gaps in slope instead
// of at pairwise crossings: bricks come front to back, so one sweep finds them without storing candidates,
// and their number has no limit. And a surface that does not cover the output is not dropped but weighted by
// its density, so that small and thin objects keep their brightness.
//
// What lib/search.glsl needs of a sweep; with kMoving as there. In C++ it is included in a struct, after
// lib/surface.glsl.
#include "lib/surface.glsl"

struct Sweep {
    bool running; // false: nothing behind shows through
    float baseRadius, surfaceGap, fullWeight;
    Surface surface;        // the last one
    Composite composite;    // of those before it
    VelocityBox velocities; // of the last one
};

KERNEL Sweep newSweep(IN(GridLayout) grid, float baseRadius) {
    const float widening = baseRadius / grid.radiusPx;
    const Composite none = {vec3(0.0f), 1.0f};
    const Sweep sweep = {true,        baseRadius, grid.surfaceGap, kFullWeight * widening * widening,
                         noSurface(), none,       noVelocities()};
    return sweep;
}

KERNEL void visit(IN(Candidate) candidate, INOUT(Sweep) sweep) {
    bool parted = candidate.slope > sweep.surface.slopeMax + sweep.surfaceGap;
    if (kMoving)
        parted = parted || isApart(sweep.velocities, velocityOf(candidate), kVelocityGap * sweep.surfaceGap);
    if (sweep.surface.count > 0 && parted) {
        addSurface(sweep.composite, sweep.surface, sweep.fullWeight);
        sweep.surface = noSurface();
        sweep.running = sweep.composite.transmittance > 0.0f;
        if (!sweep.running) return;
        sweep.velocities = noVelocities();
    }
    if (kMoving) addVelocity(sweep.velocities, velocityOf(candidate));
    addSample(sweep.surface, candidate, sweep.baseRadius);
}

KERNEL bool hides(IN(Sweep) sweep, IN(Brick) brick) {
    return brick.slopeMin > sweep.surface.slopeMax + sweep.surfaceGap &&
           isSolid(sweep.surface, sweep.fullWeight);
}

KERNEL bool foundNothing(IN(Sweep) sweep) {
    return sweep.surface.count == 0 && sweep.running;
}

/// All surfaces composited, where there are some.
KERNEL vec3 radianceOf(IN(Sweep) sweep) {
    vec3 rgb = sweep.composite.rgb;
    if (sweep.surface.count > 0) rgb += sweep.composite.transmittance * meanOf(sweep.surface);
    return rgb;
}

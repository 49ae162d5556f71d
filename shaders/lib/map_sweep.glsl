// The surfaces around the middle of a texel of the layer map's level 0, weighted by a tent over map.tentPx.
// Where there are several, the samples within twice that separate them, as in lib/visibility.glsl.
//
// What lib/search.glsl needs of a sweep; with kMoving as there. Needs, declared before the
// include: a struct LayerTexel with a member `int count`, its layers; noLayers(), which makes an empty one;
// and keepLayer(vec3 rgb, float coverage, float slope, vec3 motion, SlopeCode, inout LayerTexel), which adds
// a layer. In C++ it is included in a struct, after lib/surface.glsl and before lib/search.glsl.
#include "lib/surface.glsl"

struct Sweep {
    bool running; // false: the texel has all its layers
    float radius, maxRadiusRatio, surfaceGap, fullWeight;
    SlopeCode code;
    Surface surface; // the last one
    LayerTexel texel;
    VelocityBox velocities; // of the last surface
    vec3 motionSum;         // of it, with the inner weights
};

KERNEL Sweep newSweep(IN(GridLayout) grid, float tentPx, float texelsPerPixel, IN(SlopeCode) code) {
    const float widening = tentPx / grid.radiusPx;
    const Sweep sweep = {true,
                         tentPx,
                         tentPx * texelsPerPixel,
                         grid.surfaceGap,
                         kFullWeight * widening * widening,
                         code,
                         noSurface(),
                         noLayers(),
                         noVelocities(),
                         vec3(0.0f)};
    return sweep;
}

/// Makes a layer of a surface. A surface with nothing before or behind it fills the texel.
KERNEL void close(INOUT(Sweep) sweep, bool last) {
    const Surface surface = sweep.surface;
    if (!(surface.innerWeight > 0.0f)) return;
    const bool full = (last && sweep.texel.count == 0) || isSolid(surface, sweep.fullWeight);
    const float coverage = full ? 1.0f : min(surface.innerWeight / sweep.fullWeight, 1.0f);
    vec3 motion = vec3(0.0f);
    if (kMoving) motion = sweep.motionSum / surface.innerWeight;
    keepLayer(surface.innerSum / surface.innerWeight, coverage, surface.slopeSum / surface.innerWeight,
              motion, sweep.code, sweep.texel);
}

KERNEL void visit(IN(Candidate) candidate, INOUT(Sweep) sweep) {
    bool parted = candidate.slope > sweep.surface.slopeMax + sweep.surfaceGap;
    if (kMoving)
        parted = parted || isApart(sweep.velocities, velocityOf(candidate), kVelocityGap * sweep.surfaceGap);
    if (sweep.surface.count > 0 && parted) {
        close(sweep, false);
        sweep.surface = noSurface();
        sweep.velocities = noVelocities();
        sweep.motionSum = vec3(0.0f);
        sweep.running = sweep.texel.count < kMapLayers;
        if (!sweep.running) return;
    }
    // Where own radii are smaller than the tent's, it contains more samples than it needs.
    const float widened = min(candidate.value.w, sweep.maxRadiusRatio) / candidate.value.w;
    Candidate spread = candidate;
    spread.weight *= widened * widened;
    addSample(sweep.surface, spread, sweep.radius);
    if (!kMoving) return;
    addVelocity(sweep.velocities, velocityOf(candidate));
    sweep.motionSum += innerWeightOf(spread, sweep.radius) * candidate.motion;
}

KERNEL bool hides(IN(Sweep), IN(Brick)) {
    return false;
}

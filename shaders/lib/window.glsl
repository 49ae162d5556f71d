// One output of the method `window`, which host/reconstruct/window.h explains.
//
// Needs, declared before the include: positionAt(uint), valueAt(uint) and pixelStartAt(int), which read
// the samples; kMoving, whether anything moves, and then motionAt(uint); keepCandidate(int place,
// WindowCandidate) and keptCandidate(int place, Output), which hold candidates; and sortCandidates(int
// count), which puts them front to back, and in the order of samples where slopes are equal. In C++ it is
// included in a struct that has these, after lib/candidate.glsl, lib/gaussian.glsl and lib/output.glsl.
#include "shared/window.h"
#include "lib/candidate.glsl"
#include "lib/gaussian.glsl"
#include "lib/motion.glsl"
#include "lib/output.glsl"

/// What is known about an apparent surface.
struct WindowSurface {
    int count;
    vec3 sum;
    float weightSum;
    Hull hull;
};

KERNEL WindowSurface noWindowSurface() {
    const WindowSurface surface = {0, vec3(0.0f), 0.0f, noHull()};
    return surface;
}

/// A sample as the output sees it.
KERNEL WindowCandidate candidateAt(uint record, IN(vec4) position, IN(Output) o) {
    Trajectory trajectory = {vec2(position), position.z};
    vec2 velocity = vec2(0.0f);
    if (kMoving) {
        const Motion motion = motionOf(motionAt(record));
        trajectory = atTime(trajectory, motion, o.t - 0.5f);
        velocity = motion.velocity;
    }
    vec2 offset = seenFrom(trajectory, o.uv) - o.xy;
    if (o.onSceneSide) offset = onFilm(o, offset);
    const WindowCandidate candidate = {offset, offset.x * offset.x + offset.y * offset.y, trajectory.slope,
                                       record, velocity};
    return candidate;
}

KERNEL void addToSurface(INOUT(WindowSurface) surface, IN(WindowCandidate) candidate, float alpha) {
    const float weight = expOfMinus(min(alpha * candidate.distance2, kMaxExponent));
    surface.count += 1;
    surface.sum += weight * vec3(valueAt(candidate.record));
    surface.weightSum += weight;
    addPoint(surface.hull, candidate.offset);
}

/// Whether two trajectories keep their order, in x and in y, over a lens step to either side and half as much
/// of the shutter, which is half as long as the lens is wide.
KERNEL bool sameSurface(IN(WindowCandidate) a, IN(WindowCandidate) b, float lensStep) {
    const vec2 apart = a.offset - b.offset;
    vec2 shear = vec2((a.slope - b.slope) * lensStep);
    if (kMoving) shear = abs(shear) + abs(a.velocity - b.velocity) * (0.5f * lensStep);
    return (apart.x + shear.x > 0.0f) == (apart.x - shear.x > 0.0f) &&
           (apart.y + shear.y > 0.0f) == (apart.y - shear.y > 0.0f);
}

struct WindowFinds {
    int count;      // samples that reproject to within their radius; candidates 0 to count - 1
    uint nearest;   // of all samples of the window
    float nearest2; // its distance; infinite where there are none
};

/// Keeps the candidates of a pixel's output.
KERNEL WindowFinds collect(IN(WindowSearch) search, ivec2 pixel, IN(Output) o) {
    WindowFinds finds = {0, 0u, kInfinity};
    const ivec2 center = pixel - search.boundsOrigin;
    const ivec2 first = max(center - search.rangePx, ivec2(0));
    const ivec2 last = min(center + search.rangePx, search.boundsSize - 1);
    for (int y = first.y; y <= last.y; ++y) {
        if (last.x < first.x) break;
        const int row = y * search.boundsSize.x;
        const uint begin = pixelStartAt(row + first.x), end = pixelStartAt(row + last.x + 1);
        for (uint record = begin; record < end; ++record) {
            IN(vec4) position = positionAt(record);
            const WindowCandidate candidate = candidateAt(record, position, o);
            if (candidate.distance2 < finds.nearest2) {
                finds.nearest2 = candidate.distance2;
                finds.nearest = record;
            }
            if (!(candidate.distance2 < position.w)) continue;
            keepCandidate(finds.count, candidate);
            ++finds.count;
        }
    }
    return finds;
}

/// What an output sees.
struct WindowView {
    uint outcome; // kWindowFound ...
    vec3 rgb;
};

/// The foremost surface that surrounds the output; if there is none, the foremost of all.
KERNEL WindowView viewOf(IN(WindowSearch) search, IN(WindowFinds) finds, IN(Output) o) {
    WindowView view = {kWindowHole, vec3(0.0f)};
    if (finds.count == 0) {
        if (search.fill == 0u || !(finds.nearest2 < kInfinity)) return view;
        view.outcome = kWindowFilled;
        view.rgb = vec3(valueAt(finds.nearest));
        return view;
    }
    // Sorts here and not while gathering: lavapipe counts a step of an inner loop even if it is not entered.
    sortCandidates(finds.count);
    WindowSurface front = noWindowSurface(), surface = noWindowSurface();
    WindowCandidate previous = {vec2(0.0f), 0.0f, 0.0f, 0u, vec2(0.0f)};
    bool taken = false;
    for (int i = 0; i < finds.count && !taken; ++i) {
        IN(WindowCandidate) candidate = keptCandidate(i, o);
        if (surface.count >= kMinSurface && !sameSurface(previous, candidate, search.lensStep)) {
            taken = surrounds(surface.hull);
            if (taken) break;
            if (front.count == 0) front = surface;
            surface = noWindowSurface();
        }
        addToSurface(surface, candidate, search.alpha);
        previous = candidate;
    }
    taken = taken || surrounds(surface.hull);
    const bool parted = taken ? surface.count < finds.count : front.count > 0;
    if (!taken && front.count > 0) surface = front;
    view.outcome = parted ? kWindowParted : kWindowFound;
    view.rgb = surface.sum / surface.weightSum;
    return view;
}

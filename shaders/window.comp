#version 460
// Dense samples from a fixed window of pixels. One invocation an output; neighbours in x are neighbours in a vector, and
// their windows have the same size. As host/reconstruct/window.cpp, where it is explained.
#extension GL_GOOGLE_include_directive : require
#include "lib/candidate.glsl"
#include "lib/gaussian.glsl"
#include "lib/invocation.glsl"
#include "shared/window.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform textureBuffer positions; // p.x, p.y, slope, square of its radius; in pixel order
layout(set = 0, binding = 1) uniform textureBuffer values;
layout(set = 0, binding = 2) uniform utextureBuffer pattern;
layout(set = 0, binding = 3, rgba32f) uniform writeonly imageBuffer dense;
layout(set = 0, binding = 4, r32ui) uniform uimageBuffer counters;
layout(set = 0, binding = 5, r32ui) uniform writeonly uimageBuffer overflowList;
layout(set = 0, binding = 6) uniform textureBuffer apertureTable;
layout(set = 0, binding = 7) uniform utextureBuffer pixelStart;
layout(set = 0, binding = 8) uniform textureBuffer lensMap;
layout(push_constant) uniform Push { WindowPush push; };

float apertureAt(int i) { return texelFetch(apertureTable, i).x; }
vec4 lensMapAt(int texel) { return texelFetch(lensMap, texel); }
#include "lib/output_pattern.glsl"
#include "lib/scene_side.glsl"

struct WindowSurface {
    int count;
    vec3 sum;
    float weightSum;
    Hull hull;
};

WindowSurface noSurface() { return WindowSurface(0, vec3(0.0), 0.0, noHull()); }

struct WindowCandidate {
    vec2 offset; // from the output, pixels
    float distance2, slope, radius2;
    uint record;
};

WindowCandidate candidateAt(uint record, Output o) {
    const vec4 position = texelFetch(positions, int(record));
    vec2 offset = position.xy + position.z * o.uv - o.xy;
    if (kCompoundLens) offset = onFilm(o, offset);
    return WindowCandidate(offset, offset.x * offset.x + offset.y * offset.y, position.z, position.w, record);
}

void addSample(inout WindowSurface surface, WindowCandidate candidate, float alpha) {
    const float weight = expOfMinus(min(alpha * candidate.distance2, kMaxExponent));
    surface.count += 1;
    surface.sum += weight * texelFetch(values, int(candidate.record)).rgb;
    surface.weightSum += weight;
    addPoint(surface.hull, candidate.offset);
}

/// Whether two trajectories have the same order, in x and in y, a lens step to either side.
bool sameSurface(WindowCandidate a, WindowCandidate b, float lensStep) {
    const vec2 apart = a.offset - b.offset;
    const float shear = (a.slope - b.slope) * lensStep;
    return (apart.x + shear > 0.0) == (apart.x - shear > 0.0) && (apart.y + shear > 0.0) == (apart.y - shear > 0.0);
}

void count(uint counter) { imageAtomicAdd(counters, int(counter), 1u); }

void main() {
    const uint slot =
        linearInvocation(gl_WorkGroupID, gl_NumWorkGroups, gl_WorkGroupSize, gl_LocalInvocationIndex);
    if (slot >= push.count) return;
    const OutputLayout outputs = push.outputs;
    const WindowSearch search = push.search;
    const uvec2 size = uvec2(outputs.regionSize);
    const uint k = slot / (size.x * size.y), place = slot - k * (size.x * size.y);
    const ivec2 pixel = outputs.regionOrigin + ivec2(place % size.x, place / size.x);
    const int index = push.firstOutput + int(k);
    Output o = outputAt(pixel, index, texelFetch(pattern, index), push.lensCells, push.lensScale, outputs.seed);
    if (kCompoundLens) {
        toSceneSide(o);
        if (!(o.weight > 0.0)) { // the film is dark
            imageStore(dense, int(slot), vec4(0.0, 0.0, 0.0, o.positionCode));
            return;
        }
    }

    float slopes[kMaxWindowCandidates];
    uint records[kMaxWindowCandidates];
    int found = 0;
    uint nearest = 0u;
    float nearest2 = kInfinity;
    const ivec2 center = pixel - search.boundsOrigin;
    const ivec2 first = max(center - search.rangePx, ivec2(0));
    const ivec2 last = min(center + search.rangePx, search.boundsSize - 1);
    for (int y = first.y; y <= last.y; ++y) {
        if (last.x < first.x) break;
        const int row = y * search.boundsSize.x;
        const uint begin = texelFetch(pixelStart, row + first.x).x, end = texelFetch(pixelStart, row + last.x + 1).x;
        for (uint record = begin; record < end; ++record) {
            const WindowCandidate candidate = candidateAt(record, o);
            if (candidate.distance2 < nearest2) {
                nearest2 = candidate.distance2;
                nearest = record;
            }
            if (!(candidate.distance2 < candidate.radius2)) continue;
            if (found < kMaxWindowCandidates) {
                slopes[found] = candidate.slope;
                records[found] = record;
            }
            ++found;
        }
    }
    if (found > kMaxWindowCandidates) {
        imageStore(overflowList, int(imageAtomicAdd(counters, int(kOverflowCount), 1u)), uvec4(slot));
        return;
    }
    if (found == 0) {
        const bool filled = search.fill != 0u && nearest2 < kInfinity;
        count(filled ? kFilledCount : kHoleCount);
        const vec3 rgb = filled ? texelFetch(values, int(nearest)).rgb : vec3(0.0);
        imageStore(dense, int(slot), vec4(o.weight * rgb, o.positionCode));
        return;
    }

    // Front to back, in the order of samples where slopes are equal. Not while they are gathered: lavapipe counts a step
    // of an inner loop even where it is not entered.
    for (int i = 1; i < found; ++i) {
        const float slope = slopes[i];
        const uint record = records[i];
        int at = i;
        for (; at > 0 && slopes[at - 1] > slope; --at) {
            slopes[at] = slopes[at - 1];
            records[at] = records[at - 1];
        }
        slopes[at] = slope;
        records[at] = record;
    }

    WindowSurface front = noSurface(), surface = noSurface();
    WindowCandidate previous;
    bool taken = false;
    for (int i = 0; i < found && !taken; ++i) {
        const WindowCandidate candidate = candidateAt(records[i], o);
        if (surface.count >= kMinSurface && !sameSurface(previous, candidate, search.lensStep)) {
            taken = surrounds(surface.hull);
            if (taken) break;
            if (front.count == 0) front = surface;
            surface = noSurface();
        }
        addSample(surface, candidate, search.alpha);
        previous = candidate;
    }
    taken = taken || surrounds(surface.hull);
    if (taken ? surface.count < found : front.count > 0) count(kVisibilityCount);
    if (!taken && front.count > 0) surface = front;
    imageStore(dense, int(slot), vec4(o.weight * (surface.sum / surface.weightSum), o.positionCode));
}

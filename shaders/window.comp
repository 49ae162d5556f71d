#version 460
// Dense samples from a fixed window of pixels. One invocation per output; neighbours in x are neighbours in
// a vector, and their windows have the same size.
#extension GL_GOOGLE_include_directive : require
#include "shared/window.h"
#include "resources/compound_lens.glsl"
#include "resources/invocation.glsl"
#include "resources/moving.glsl"

layout(local_size_x = 64) in;
layout(set = 0,
       binding = 0) uniform textureBuffer positions; // p.x, p.y, slope, square of its radius; in pixel order
layout(set = 0, binding = 1) uniform textureBuffer values;
layout(set = 0, binding = 2) uniform utextureBuffer pattern;
layout(set = 0, binding = 3, rgba32f) uniform writeonly imageBuffer dense;
layout(set = 0, binding = 4, r32ui) uniform uimageBuffer counters;
layout(set = 0, binding = 5, r32ui) uniform writeonly uimageBuffer overflowList;
layout(set = 0, binding = 6) uniform textureBuffer apertureTable;
layout(set = 0, binding = 7) uniform utextureBuffer pixelStart;
layout(set = 0, binding = 8) uniform textureBuffer lensMap;
layout(set = 0, binding = 9) uniform textureBuffer motions; // Motion
layout(set = 0, binding = 10) uniform textureBuffer motionTexels;
layout(push_constant) uniform Push {
    WindowPush push;
};

float apertureAt(int i) {
    return texelFetch(apertureTable, i).x;
}
vec4 lensMapAt(int texel) {
    return texelFetch(lensMap, texel);
}
vec4 positionAt(uint record) {
    return texelFetch(positions, int(record));
}
vec4 motionAt(uint record) {
    return texelFetch(motions, int(record));
}
vec4 valueAt(uint record) {
    return texelFetch(values, int(record));
}
uint pixelStartAt(int pixel) {
    return texelFetch(pixelStart, pixel).x;
}
#include "lib/aperture.glsl"
#include "lib/lens_map.glsl"
#include "lib/output_pattern.glsl"
#include "shared/window.h"

float slopes[kMaxWindowCandidates];
uint records[kMaxWindowCandidates];

void keepCandidate(int place, WindowCandidate candidate) {
    if (place >= kMaxWindowCandidates) return;
    slopes[place] = candidate.slope;
    records[place] = candidate.record;
}

WindowCandidate candidateAt(uint record, vec4 position, Output o);
WindowCandidate keptCandidate(int place, Output o) {
    return candidateAt(records[place], positionAt(records[place]), o);
}

void sortCandidates(int count) {
    for (int i = 1; i < count; ++i) {
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
}
#include "lib/window.glsl"

void count(uint counter) {
    imageAtomicAdd(counters, int(counter), 1u);
}

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
    Output o =
        outputAt(pixel, index, texelFetch(pattern, index), push.lensCells, push.lensScale, outputs.seed);
    if (kMoving) {
        const MotionLayout motionLayout = READ_MOTION_LAYOUT;
        o.t = timeInShutter(pixel, index, texelFetch(pattern, index).z, outputs.outputsPerPixel, outputs.seed,
                            vec2(motionLayout.shutterOpen, motionLayout.shutterSpan));
    }
    if (kCompoundLens) {
        toSceneSide(o, sceneRay(o.xy, o.uv));
        if (!(o.weight > 0.0)) { // the film is dark
            imageStore(dense, int(slot), vec4(0.0, 0.0, 0.0, o.positionCode));
            return;
        }
    }

    const WindowFinds finds = collect(search, pixel, o);
    if (finds.count > kMaxWindowCandidates) {
        imageStore(overflowList, int(imageAtomicAdd(counters, int(kOverflowCount), 1u)), uvec4(slot));
        return;
    }
    const WindowView view = viewOf(search, finds, o);
    if (view.outcome == kWindowParted) count(kVisibilityCount);
    if (view.outcome == kWindowFilled) count(kFilledCount);
    if (view.outcome == kWindowHole) count(kHoleCount);
    imageStore(dense, int(slot), vec4(o.weight * view.rgb, o.positionCode));
}

#version 460
// Dense samples, first try: the front-most apparent surface within R. One workgroup is one output of each pixel of
// one tile; what needs more is appended to a list for visibility.comp.
#extension GL_GOOGLE_include_directive : require
#include "lib/bins.glsl"
#include "lib/candidate.glsl"
#include "lib/grid.glsl"
#include "lib/invocation.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 7, rgba32f) uniform writeonly imageBuffer dense;
layout(set = 0, binding = 8, r32ui) uniform uimageBuffer counters;
layout(set = 0, binding = 9, r32ui) uniform writeonly uimageBuffer visibilityList;
layout(set = 0, binding = 10, r32ui) uniform writeonly uimageBuffer overflowList;

struct Sweep {
    bool running;
    float invRadius, surfaceGap;
    vec3 sum;
    float weightSum, slopeMax;
    int count;
    Hull hull;
};

void visit(Candidate candidate, inout Sweep sweep) {
    if (sweep.weightSum > 0.0 && candidate.slope > sweep.slopeMax + sweep.surfaceGap) {
        sweep.running = false; // there is another surface behind
        return;
    }
    const float weight = 1.0 - sqrt(candidate.distance2) * sweep.invRadius;
    sweep.sum += weight * radianceAt(candidate.record);
    sweep.weightSum += weight;
    sweep.slopeMax = max(sweep.slopeMax, candidate.slope);
    sweep.count += 1;
    addPoint(sweep.hull, candidate.offset);
}
#include "lib/search.glsl"

void main() {
    const uint invocation =
        linearInvocation(gl_WorkGroupID, gl_NumWorkGroups, gl_WorkGroupSize, gl_LocalInvocationIndex);
    if (invocation >= push.count) return;
    const OutputLayout outputs = push.outputs;
    const GridLayout grid = push.grid;
    const uint tiles = uint(outputs.tileCount.x * outputs.tileCount.y);
    // Eight neighbouring lanes take two lens positions of a square of two by two pixels: of the ways to split a tile
    // and a lens group this keeps their candidates most alike.
    const uint groupSize = uint(min(kOutputsPerGroup, outputs.outputsPerPixel)), pair = min(groupSize, 2u);
    const uint list = invocation / (64u * groupSize), group = list / tiles, tile = list - group * tiles;
    const uint k = group * groupSize + invocation % pair + pair * (invocation / (4u * pair) % (groupSize / pair));
    const uint quad = invocation / pair & 3u, block = invocation / (4u * groupSize) & 15u;
    const ivec2 corner = kTileSize * ivec2(tile % uint(outputs.tileCount.x), tile / uint(outputs.tileCount.x));
    const ivec2 position = corner + 2 * ivec2(block & 3u, block >> 2) + ivec2(quad & 1u, quad >> 1);
    if (position.x >= outputs.regionSize.x || position.y >= outputs.regionSize.y) return;

    const int index = push.firstOutput + int(k);
    const Output o = outputAt(outputs.regionOrigin + position, index, texelFetch(pattern, index), push.lensCells,
                              outputs.seed);
    Sweep sweep = Sweep(true, 1.0 / grid.radiusPx, grid.surfaceGap, vec3(0.0), 0.0, -kInfinity, 0, noHull());
    const bool complete = forEachCandidate(grid, o, grid.radiusPx, texelFetch(listStart, int(list)).x,
                                           texelFetch(listStart, int(list) + 1).x, sweep);
    const uint slot = (k * uint(outputs.regionSize.y) + uint(position.y)) * uint(outputs.regionSize.x) + uint(position.x);
    if (!complete) {
        imageStore(overflowList, int(imageAtomicAdd(counters, int(kOverflowCount), 1u)), uvec4(slot));
        return;
    }
    const bool taken =
        sweep.running ? sweep.weightSum > 0.0 : sweep.count >= kMinSurfaceSamples && surrounds(sweep.hull);
    if (taken)
        imageStore(dense, int(slot), vec4(sweep.sum / sweep.weightSum, o.positionCode));
    else
        imageStore(visibilityList, int(imageAtomicAdd(counters, int(kVisibilityCount), 1u)), uvec4(slot));
}

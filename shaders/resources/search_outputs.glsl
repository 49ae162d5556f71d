// The pass that searches the bins for outputs: one workgroup is one output of each pixel of one tile.
// Outputs that its kernel does not take are appended to a list for visibility.comp.
//
// Needs, declared before the include: what lib/search.glsl needs of a sweep; newSweep(float radiusPx, float
// surfaceGap); isTaken(Sweep), whether the output sees what was found within R; and valueOf(Sweep), its
// value.
#include "resources/bins.glsl"
#include "resources/compound_lens.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 9) uniform utextureBuffer pattern;
layout(set = 0, binding = 10, rgba32f) uniform writeonly imageBuffer dense;
layout(set = 0, binding = 11, r32ui) uniform uimageBuffer counters;
layout(set = 0, binding = 12, r32ui) uniform writeonly uimageBuffer visibilityList;
layout(set = 0, binding = 13, r32ui) uniform writeonly uimageBuffer overflowList;
layout(set = 0, binding = 14) uniform utextureBuffer left; // lists to search for: tile x, y, lens group, list
layout(set = 0, binding = 15) uniform textureBuffer apertureTable;
layout(set = 0, binding = 16) uniform textureBuffer lensMap;
layout(set = 0, binding = 17) uniform utextureBuffer missed; // two per list: a bit for each pixel left

float apertureAt(int i) {
    return texelFetch(apertureTable, i).x;
}
vec4 lensMapAt(int texel) {
    return texelFetch(lensMap, texel);
}
#include "lib/aperture.glsl"
#include "lib/lens_map.glsl"
#include "lib/output_pattern.glsl"
#include "lib/search.glsl"

/// Output of a lens group, of those that stand at `rank` in its order.
uint memberAt(uint firstOfGroup, uint rank) {
    return uint(inOrder(texelFetch(pattern, push.firstOutput + int(firstOfGroup + rank))));
}

void main() {
    // Workgroups that share a list follow one another. There is no division: lavapipe divides lane by lane.
    readMotionLayout();
    const OutputLayout outputs = push.outputs;
    const GridLayout grid = push.grid;
    const int groupBits = push.groupBits, takenBits = push.takenBits;
    const uint workgroup = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    if (workgroup >> takenBits >= push.count) return;
    const uvec4 item = texelFetch(left, int(workgroup >> takenBits));
    const uvec2 tile = item.xy;
    const uint group = item.z, list = item.w;
    // Splits the 64 << takenBits outputs of this list: eight neighbouring lanes take two lens positions of
    // two by two pixels. Among the ways to split a tile and a lens group, this one makes their candidates
    // most similar.
    const uint place = bitfieldExtract(workgroup, 0, takenBits) << 6 | gl_LocalInvocationIndex;
    const int pairBits = min(takenBits, 1), restBits = takenBits - pairBits;
    const uint pair = bitfieldExtract(place, 0, pairBits), quad = bitfieldExtract(place, pairBits, 2);
    const uint rest = bitfieldExtract(place, pairBits + 2, restBits), block = place >> (takenBits + 2);
    const uint firstOfGroup = group << groupBits;
    const uint rank = (rest << pairBits) + pair;
    const uint k = firstOfGroup + (takenBits < groupBits ? memberAt(firstOfGroup, rank) : rank);
    const ivec2 position =
        kTileSize * ivec2(tile) + 2 * ivec2(block & 3u, block >> 2) + ivec2(quad & 1u, quad >> 1);
    if (position.x >= outputs.regionSize.x || position.y >= outputs.regionSize.y) return;
    const uint inTile = uint(position.y % kTileSize * kTileSize + position.x % kTileSize);
    if ((texelFetch(missed, int(2u * list + (inTile >> 5))).x >> (inTile & 31u) & 1u) == 0u) return;

    const int index = push.firstOutput + int(k);
    Output o = outputAt(outputs.regionOrigin + position, index, texelFetch(pattern, index), push.lensCells,
                        push.lensScale, outputs.seed);
    if (kMoving)
        o.t = timeInShutter(outputs.regionOrigin + position, index, texelFetch(pattern, index).z,
                            outputs.outputsPerPixel, outputs.seed,
                            vec2(motionLayout.shutterOpen, motionLayout.shutterSpan));
    const uint plane = uint(outputs.regionSize.x * outputs.regionSize.y);
    const uint inPlane = uint(position.y * outputs.regionSize.x + position.x), slot = k * plane + inPlane;
    for (uint other = rank + (1u << takenBits); other < 1u << groupBits; other += 1u << takenBits)
        imageStore(dense, int((firstOfGroup + memberAt(firstOfGroup, other)) * plane + inPlane),
                   vec4(vec3(0.0), kLeftOut));
    if (kCompoundLens) {
        toSceneSide(o, sceneRay(o.xy, o.uv));
        if (!(o.weight > 0.0)) { // the film is dark
            imageStore(dense, int(slot), vec4(0.0, 0.0, 0.0, o.positionCode));
            return;
        }
    }
    Sweep sweep = newSweep(grid.radiusPx, grid.surfaceGap);
    const uint begin = texelFetch(listStart, int(list)).x, end = texelFetch(listStart, int(list) + 1).x;
    const int steps = forEachCandidate(grid, o, grid.radiusPx, kAnyRadiusRatio, begin, end, sweep);
    if (steps > kMaxSteps)
        imageStore(overflowList, int(imageAtomicAdd(counters, int(kOverflowCount), 1u)), uvec4(slot));
    else if (isTaken(sweep))
        imageStore(dense, int(slot), vec4(o.weight * valueOf(sweep), o.positionCode));
    else
        imageStore(visibilityList, int(imageAtomicAdd(counters, int(kVisibilityCount), 1u)), uvec4(slot));
}

#version 460
// For each list: the clusters of surfaces that it sees, if its outputs can be taken from the layer map. As classOfList of
// host/reconstruct/map_lookup.cpp.
#extension GL_GOOGLE_include_directive : require
#include "lib/candidate.glsl"
#include "lib/grid.glsl"
#include "lib/invocation.glsl"
#include "shared/layer_map.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform utextureBuffer listStart;
layout(set = 0, binding = 1) uniform utextureBuffer listBricks;
layout(set = 0, binding = 2) uniform textureBuffer lensBoxes;
layout(set = 0, binding = 3, r32ui) uniform writeonly uimageBuffer classes;
layout(set = 0, binding = 4, rgba32f) uniform writeonly imageBuffer clusters; // from the list's start on
layout(set = 0, binding = 5, r32ui) uniform writeonly uimageBuffer missed;     // two a list
layout(push_constant) uniform Push { MapLookupPush push; };

struct Clusters {
    uint count;
    bool fits, inFocus, sparse;
    vec2 open; // least and greatest slope
};

/// Level of the map where lens positions are near enough to one another on a surface of this slope or more.
float levelFor(float slope) {
    float spacing = float(push.map.texelsPerPixel) * push.map.spreadPerPx * max(slope, 0.0);
    int level = 0;
    for (; level + 1 < push.map.levels && spacing >= kLevelSpacing; ++level) spacing *= 0.5;
    return float(level);
}

void close(inout Clusters found, float lensRadius, float lensWidth, uint listBegin) {
    const float least = max(found.open.x, -found.open.y);
    const float most = max(-found.open.x, found.open.y), reach = most * lensRadius;
    found.inFocus = found.inFocus || least < kMinSlope;
    found.sparse = found.sparse && most * lensWidth <= kSparsePx;
    found.fits = found.fits && reach <= push.map.reachPx &&
                 (found.open.y - found.open.x) * lensRadius <= kWidestClusterPx && found.count < kMaxClusters;
    imageStore(clusters, int(listBegin + found.count), vec4(found.open, levelFor(least), 0.0));
    ++found.count;
}

void main() {
    const uint list = linearInvocation(gl_WorkGroupID, gl_NumWorkGroups, gl_WorkGroupSize, gl_LocalInvocationIndex);
    if (list >= push.count) return;
    const uint tiles = uint(push.outputs.tileCount.x) * uint(push.outputs.tileCount.y);
    const vec4 box = texelFetch(lensBoxes, int(push.firstGroup + list / tiles));
    const vec2 farthest = max(abs(box.xy), abs(box.zw));
    const float lensRadius = min(sqrt(farthest.x * farthest.x + farthest.y * farthest.y), push.lensScale);
    const float lensWidth = max(box.z - box.x, box.w - box.y);
    const uint begin = texelFetch(listStart, int(list)).x, end = texelFetch(listStart, int(list) + 1).x;
    Clusters found = Clusters(0u, true, false, true, vec2(kInfinity, -kInfinity));
    float finest = 1.0; // own radius, over R
    const uint last = min(end, begin + uint(kMaxLoopIterations));
    for (uint entry = begin; entry < last; ++entry) {
        const Brick brick = brickOf(texelFetch(listBricks, int(entry)));
        finest = min(finest, widestRadius(brick));
        if (entry > begin && brick.slopeMin > found.open.y + push.map.surfaceGap) {
            close(found, lensRadius, lensWidth, begin);
            found.open = vec2(brick.slopeMin, brick.slopeMax);
        }
        found.open = vec2(min(found.open.x, brick.slopeMin), max(found.open.y, brick.slopeMax));
    }
    if (end > begin) close(found, lensRadius, lensWidth, begin);
    const bool tooCoarse = finest * push.map.radiusPx * float(push.map.texelsPerPixel) < 1.0;
    found.fits = found.fits && found.count > 0u && last == end && !(found.inFocus && (tooCoarse || found.count > kMaxInFocusClusters));
    uint listClass = found.fits ? found.count : 0u;
    if (found.fits && found.inFocus) listClass |= kInFocusBit;
    if (found.sparse && last == end && end > begin) listClass |= kSparseBit;
    imageStore(classes, int(list), uvec4(listClass));
    const uvec4 left = uvec4(found.fits ? 0u : ~0u);
    imageStore(missed, 2 * int(list), left);
    imageStore(missed, 2 * int(list) + 1, left);
}

#version 460
// The outputs of lists that the layer map serves: one invocation takes all those of a pixel. Where one of
// them meets nothing, it leaves the pixel, or the whole list, to reconstruct.comp.
#extension GL_GOOGLE_include_directive : require
#include "lib/output.glsl"
#include "resources/cluster.glsl"
#include "resources/compound_lens.glsl"
#include "resources/moving.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform utextureBuffer listStart;
layout(set = 0, binding = 1) uniform textureBuffer clusters;
layout(set = 0, binding = 2) uniform utextureBuffer texels;
layout(set = 0, binding = 3) uniform textureBuffer lensPoints;
layout(set = 0, binding = 4) uniform utextureBuffer pattern;
layout(set = 0, binding = 5) uniform utextureBuffer classes;
layout(set = 0, binding = 6, rgba32f) uniform writeonly imageBuffer dense;
layout(set = 0, binding = 7, r32ui) uniform uimageBuffer missed; // two per list: a bit for each pixel
layout(set = 0, binding = 8) uniform utextureBuffer mapMotions;  // of both layers
layout(set = 0, binding = 9) uniform textureBuffer motionTexels;
layout(set = 0, binding = 10) uniform textureBuffer lensMap;
layout(set = 0, binding = 11) uniform textureBuffer distortion;
layout(set = 0, binding = 12) uniform textureBuffer apertureTable;
layout(push_constant) uniform Push {
    MapLookupPush push;
};

#define mapLayout push.map
uvec4 mapTexelAt(int i) {
    return texelFetch(texels, i);
}
uvec4 mapMotionAt(int i) {
    return texelFetch(mapMotions, i);
}
Cluster clusterAt(int i) {
    if (!kMoving) return clusterOf(texelFetch(clusters, i), vec4(0.0));
    return clusterOf(texelFetch(clusters, kClusterTexels * i), texelFetch(clusters, kClusterTexels * i + 1));
}
MotionLayout motionLayout;
vec4 distortionHead;
vec4 distortionAt(int texel) {
    return texelFetch(distortion, texel);
}
vec4 lensMapAt(int texel) {
    return texelFetch(lensMap, texel);
}
float apertureAt(int i) {
    return texelFetch(apertureTable, i).x;
}
#include "lib/aperture.glsl"
#include "lib/lens_map.glsl"
#include "lib/map_lookup.glsl"
#include "lib/output_pattern.glsl"

/// Leaves this pixel to the bins, or all of the list.
void miss(int list, uint clusterCount) {
    const bool whole = clusterCount > kPartClusters;
    const uint word = gl_LocalInvocationIndex >> 5, bit = 1u << (gl_LocalInvocationIndex & 31u);
    imageAtomicOr(missed, 2 * list + int(word), whole ? ~0u : bit);
    if (whole) imageAtomicOr(missed, 2 * list + 1 - int(word), ~0u);
}

void main() {
    if (kMoving) motionLayout = READ_MOTION_LAYOUT;
    if (kCompoundLens) distortionHead = distortionAt(0);
    const uvec3 tile = gl_WorkGroupID;
    const ivec2 position = ivec2(gl_GlobalInvocationID.xy), size = push.outputs.regionSize;
    const int list =
        (int(tile.z) * push.outputs.tileCount.y + int(tile.y)) * push.outputs.tileCount.x + int(tile.x);
    const uint listClass = texelFetch(classes, list).x, clusterCount = listClass & (kInFocusBit - 1u);
    if (clusterCount == 0u) return;
    const bool inFocus = (listClass & kInFocusBit) != 0u, sparse = (listClass & kSparseBit) != 0u;
    const int groupSize = 1 << push.groupBits, taken = sparse ? 1 << push.sparseBits : groupSize;
    const int clusterBegin = int(texelFetch(listStart, list).x);
    const int firstOutput = (int(push.firstGroup) + int(tile.z)) * groupSize,
              firstPlane = int(tile.z) * groupSize;
    const ivec2 pixel = push.outputs.regionOrigin + position;
    // Positions outside the region are tested too: whether a list is served must not depend on bands.
    const bool inRegion = position.x < size.x && position.y < size.y;
    const vec2 middle = vec2(pixel) + 0.5;
    FilmPlace film;
    if (kCompoundLens) film = filmPlace(middle);
    // Rims cut the disc of a stop sharply, and evenly spaced places would miss thin slices of it: there,
    // light is that of the outputs' own places.
    const bool ofStop = kCompoundLens && lensMapAt(2).x > 0.0;
    vec3 sum = vec3(0.0);
    for (int rank = 0; rank < groupSize; ++rank) {
        if (rank >= taken && !inFocus) break;
        const int i = sparse ? inOrder(texelFetch(pattern, firstOutput + rank)) : rank;
        vec4 value = vec4(vec3(0.0), kLeftOut);
        if (rank < taken) {
            const vec4 point = texelFetch(lensPoints, firstOutput + i);
            const uvec4 entry = texelFetch(pattern, firstOutput + i);
            Output o = outputOnFilm(middle, vec2(0.0), 0.0, kWholePixel);
            float time = point.z;
            if (inFocus) {
                o = placed(pixel, entry, seedOf(pixel, push.outputs.seed));
                if (kMoving)
                    time = timeInShutter(pixel, firstOutput + i, entry.z, push.outputs.outputsPerPixel,
                                         push.outputs.seed,
                                         vec2(motionLayout.shutterOpen, motionLayout.shutterSpan)) -
                           0.5;
            }
            o.uv = point.xy;
            if (kCompoundLens) {
                if (inFocus) film = filmPlace(o.xy);
                toSceneSide(o, sceneRay(film, o.uv));
            }
            if (ofStop) {
                const Output own = outputAt(pixel, firstOutput + i, entry, push.lensCells, push.lensScale,
                                            push.outputs.seed);
                o.weight = sceneRay(own.xy, own.uv).weight;
            }
            vec3 rgb = vec3(0.0);
            if (!(kCompoundLens && o.weight == 0.0)) { // else the film is dark
                if (!look(Sight(o.xy, o.uv, time), clusterBegin, int(clusterCount), rgb)) {
                    miss(list, clusterCount);
                    return;
                }
                if (kCompoundLens) rgb *= o.weight;
            }
            sum += rgb;
            value = vec4(rgb, o.positionCode);
        }
        if (inFocus && inRegion)
            imageStore(dense, ((firstPlane + i) * size.y + position.y) * size.x + position.x, value);
    }
    if (!inFocus && inRegion)
        imageStore(dense, (firstPlane * size.y + position.y) * size.x + position.x,
                   vec4(sum / float(taken), kWholePixel));
}

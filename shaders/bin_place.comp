#version 460
// Pinhole position, radius ratio and sort key of each uploaded sample; and its motion and rank, where things
// move.
#extension GL_GOOGLE_include_directive : require
#include "lib/grid.glsl"
#include "resources/invocation.glsl"
#include "resources/moving.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform textureBuffer samples; // two texels per sample: LightFieldSample
layout(set = 0, binding = 1, rgba32f) uniform writeonly imageBuffer positions;
layout(set = 0, binding = 2, r32ui) uniform writeonly uimageBuffer keys;
layout(set = 0, binding = 3, r32ui) uniform writeonly uimageBuffer indices;
layout(set = 0, binding = 4) uniform utextureBuffer pixelSums;
layout(set = 0, binding = 5) uniform textureBuffer relativeMotions; // over depth; 1 / w
layout(set = 0, binding = 6) uniform utextureBuffer layers;         // of each class
layout(set = 0, binding = 7) uniform textureBuffer motionTexels;
layout(set = 0, binding = 8, rgba32f) uniform writeonly imageBuffer motions; // kPlacedMotionTexels per sample
layout(push_constant) uniform Push {
    BinPush push;
};

uint sumAt(uint i) {
    return texelFetch(pixelSums, int(i)).x;
}
#include "lib/density.glsl"

void main() {
    const uint i =
        linearInvocation(gl_WorkGroupID, gl_NumWorkGroups, gl_WorkGroupSize, gl_LocalInvocationIndex);
    if (i >= push.count) return;
    const vec4 place = texelFetch(samples, int(2u * i)), end = texelFetch(samples, int(2u * i + 1u));
    const Trajectory seen = trajectoryOf(place.xy, place.zw, end.z);
    MovingPoint point = MovingPoint(seen, Motion(vec2(0.0), 0.0, 0.0), 0.0);
    const int index = int(push.firstSample + i);
    const vec2 regionMin = vec2(push.regionMin), regionMax = vec2(push.regionMax);
    bool kept;
    int layer;
    if (kMoving) {
        const MotionLayout motionLayout = READ_MOTION_LAYOUT;
        point = atMiddle(seen, end.x, texelFetch(relativeMotions, int(i)), motionLayout.c2);
        kept = reachesMoving(point, regionMin, regionMax, push.marginPx);
        const float rank = rankOf(motionLayout, point.trajectory.slope, point.nearness);
        if (kept) layer = int(texelFetch(layers, layerClass(motionLayout, rank, point.motion.velocity)).x);
        imageStore(motions, kPlacedMotionTexels * index, texelOf(point.motion));
        imageStore(motions, kPlacedMotionTexels * index + 1, vec4(rank, 0.0, 0.0, 0.0));
    } else {
        kept = reaches(seen, regionMin, regionMax, push.marginPx);
        layer = bucketOf(push.grid, seen.slope);
    }
    const vec2 p = point.trajectory.pinhole;
    const float radiusRatio = kept ? radiusRatioAt(push.density, p, blurOf(point), push.grid.radiusPx) : 1.0;
    imageStore(positions, index, vec4(p, point.trajectory.slope, radiusRatio));
    imageStore(keys, index, uvec4(kept ? sortKey(push.grid, p, layer) : kNotBinned));
    imageStore(indices, index, uvec4(uint(index)));
}

#version 460
// Counts, for each block of the planes behind a sample, that its ray ends before it gets there.
#extension GL_GOOGLE_include_directive : require
#include "lib/occlusion.glsl"
#include "lib/trajectory.glsl"
#include "resources/invocation.glsl"
#include "resources/moving.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform textureBuffer samples; // two texels per sample: LightFieldSample
layout(set = 0, binding = 1, r32ui) uniform uimageBuffer stopped;
layout(set = 0, binding = 2) uniform textureBuffer relativeMotions; // over depth; 1 / w
layout(set = 0, binding = 3) uniform textureBuffer motionTexels;
layout(push_constant) uniform Push {
    BinPush push;
};

void main() {
    const uint i =
        linearInvocation(gl_WorkGroupID, gl_NumWorkGroups, gl_WorkGroupSize, gl_LocalInvocationIndex);
    if (i >= push.count) return;
    const OcclusionLayout planes = push.occlusion;
    const vec4 place = texelFetch(samples, int(2u * i)), end = texelFetch(samples, int(2u * i + 1u));
    const float slope = end.z;
    if (!isFollowed(planes, place.xy) || !(abs(slope) < kFarPx)) return; // disabled ones are far
    const vec2 origin = push.grid.origin;
    MotionLayout motionLayout;
    float rank = slope;
    int slot = 0; // its first block
    if (kMoving) {
        motionLayout = READ_MOTION_LAYOUT;
        rank = rankOf(motionLayout, slope, texelFetch(relativeMotions, int(i)).w);
        slot = slotAt(motionLayout, end.x) * blocksPerSlot(planes);
    }
    for (int plane = firstPlaneBehind(planes, rank, push.grid.surfaceGap); plane < planes.planeCount;
         ++plane) {
        const float crossed = kMoving ? slopeOfPlane(planes, motionLayout, plane) : planeSlope(planes, plane);
        const int block = blockCrossed(planes, plane, pinholeOf(place.xy, place.zw, crossed), origin);
        if (block >= 0) imageAtomicAdd(stopped, slot + block, 1u);
    }
}

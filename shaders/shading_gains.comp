#version 460
// How much of a band is kept: its powers are averaged over two passes, by the strides of this band and of the
// next; the second one decides.
#extension GL_GOOGLE_include_directive : require
#include "resources/invocation.glsl"
#include "resources/reflections.glsl"
#include "shared/shading.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform textureBuffer geometry;
layout(set = 0, binding = 1) uniform textureBuffer slopes;
layout(set = 0, binding = 2) uniform textureBuffer powers;
layout(set = 0, binding = 3) uniform textureBuffer detailsBefore; // of the band before
layout(set = 0, binding = 4, rgba32f) uniform writeonly imageBuffer smoothed;
layout(set = 0, binding = 5, rgba32f) uniform imageBuffer changes;
layout(push_constant) uniform Push {
    ShadingPush push;
};

const int kParts = kReflects ? 2 : 1;

vec4 geometryAt(int surfel) {
    return texelFetch(geometry, surfel);
}
vec2 slopesAt(int surfel) {
    return texelFetch(slopes, surfel).xy;
}
vec4 powersAt(int i) {
    return texelFetch(powers, i);
}
#include "lib/shading_gains.glsl"

void main() {
    const int surfel =
        int(linearInvocation(gl_WorkGroupID, gl_NumWorkGroups, gl_WorkGroupSize, gl_LocalInvocationIndex));
    if (surfel >= push.size.x * push.size.y * kSurfels || !(geometryAt(surfel).w > 0.0)) return;
    const Taps taps = averaged(surfel, push.size, 1 << push.band);
    for (int part = 0; part < kParts; ++part) {
        const int i = surfel * kParts + part;
        const vec4 mean = taps.powers[part] / taps.weight;
        imageStore(smoothed, i, vec4(mean.xy, 0.0, 0.0));
        if (push.band == 0) continue;
        vec4 before = vec4(0.0);
        if (push.band > 1) before = imageLoad(changes, i);
        imageStore(
            changes, i,
            changedBy(before, texelFetch(detailsBefore, i).rgb, keptShare(mean.z, mean.w), push.band == 1));
    }
}

#version 460
// The light of each surfel through a wider filter, and the band of detail that this takes away.
#extension GL_GOOGLE_include_directive : require
#include "resources/invocation.glsl"
#include "resources/reflections.glsl"
#include "shared/shading.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform textureBuffer geometry;
layout(set = 0, binding = 1) uniform textureBuffer slopes;
layout(set = 0, binding = 2) uniform textureBuffer fine; // by lightIndex
layout(set = 0, binding = 3, rgba32f) uniform writeonly imageBuffer coarse;
layout(set = 0, binding = 4) uniform textureBuffer smoothed; // of the band before: covariance, variance
layout(set = 0, binding = 5, rgba32f) uniform writeonly imageBuffer details;
layout(set = 0, binding = 6,
       rgba32f) uniform writeonly imageBuffer powers; // covariance, variance; of the band before
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
vec4 lightSumAt(int i) {
    return texelFetch(fine, i);
}
#include "lib/shading_bands.glsl"

void main() {
    const int surfel =
        int(linearInvocation(gl_WorkGroupID, gl_NumWorkGroups, gl_WorkGroupSize, gl_LocalInvocationIndex));
    if (surfel >= push.size.x * push.size.y * kSurfels || !(geometryAt(surfel).w > 0.0)) return;
    const bool last = push.band == kShadingBands;
    const Taps taps = last ? noTaps() : filtered(surfel, push.size, 1 << push.band);
    for (int part = 0; part < kParts; ++part) {
        const int i = surfel * kParts + part;
        vec2 before = vec2(0.0);
        if (push.band > 0) before = texelFetch(smoothed, i).xy;
        if (last) {
            imageStore(powers, i, vec4(0.0, 0.0, before));
            continue;
        }
        const int sums = lightIndex(surfel, part, 0, kReflects);
        const vec4 coarse0 = taps.light[2 * part], coarse1 = taps.light[2 * part + 1];
        imageStore(coarse, sums, coarse0);
        imageStore(coarse, sums + 1, coarse1);
        const Band band = bandOf(lightSumAt(sums), lightSumAt(sums + 1), coarse0, coarse1);
        imageStore(details, i, vec4(band.detail, 0.0));
        imageStore(powers, i, vec4(band.covariance, band.variance, before));
    }
}

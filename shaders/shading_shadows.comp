#version 460
// The illumination of the samples in each texel, with the shadows that their neighbours see.
#extension GL_GOOGLE_include_directive : require
#include "lib/hash.glsl"
#include "resources/invocation.glsl"
#include "shared/shading.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform utextureBuffer texelStart;  // first record of each, and of one more
layout(set = 0, binding = 1) uniform utextureBuffer records;     // in the order of their texels
layout(set = 0, binding = 2) uniform utextureBuffer samples;     // of each record
layout(set = 0, binding = 3) uniform textureBuffer surfaces;     // of each sample: normal, nearness
layout(set = 0, binding = 4) uniform textureBuffer sortedRays;   // in the order of texels
layout(set = 0, binding = 5) uniform textureBuffer sortedLights; // places
layout(set = 0, binding = 6) uniform textureBuffer direct;       // of each sample
layout(set = 0, binding = 7) uniform textureBuffer illumination;
layout(set = 0, binding = 8) uniform utextureBuffer raysOfTexels; // kSomeBlocked, kSomeUnblocked
layout(set = 0, binding = 9, rgba32f) uniform writeonly imageBuffer softened;
layout(push_constant) uniform Push {
    ShadingPush push;
};

int sampleInTexelAt(uint i) {
    return int(texelFetch(samples, int(texelFetch(records, int(i)).x)).x);
}
uint texelStartAt(int texel) {
    return texelFetch(texelStart, texel).x;
}
vec4 rayAt(uint i) {
    return texelFetch(sortedRays, int(i));
}
vec3 lightPlaceAt(uint i) {
    return texelFetch(sortedLights, int(i)).xyz;
}
uint halfAt(uint i) {
    return uint(sampleInTexelAt(i)) & 1u;
}
vec3 directAt(uint i) {
    return texelFetch(direct, sampleInTexelAt(i)).rgb;
}
vec4 normalAt(uint i) {
    return texelFetch(surfaces, sampleInTexelAt(i));
}
uint raysOf(int texel) {
    return texelFetch(raysOfTexels, texel).x;
}
#include "lib/soft_shadows.glsl"

void main() {
    const int texel =
        int(linearInvocation(gl_WorkGroupID, gl_NumWorkGroups, gl_WorkGroupSize, gl_LocalInvocationIndex));
    if (texel >= push.size.x * push.size.y) return;
    ShadowWindow window = windowAround(texel, push.size);
    const uint end = texelStartAt(texel + 1);
    for (uint i = texelStartAt(texel); i < end; ++i) {
        const int sample_ = sampleInTexelAt(i);
        const vec3 before = texelFetch(illumination, sample_).rgb;
        imageStore(softened, sample_, vec4(withSoftShadow(before, window, i, hash(uint(sample_))), 0.0));
    }
}

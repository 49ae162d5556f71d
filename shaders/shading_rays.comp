#version 460
// The shadow rays of each texel side by side, and what they are: blocked, not, or both.
#extension GL_GOOGLE_include_directive : require
#include "resources/invocation.glsl"
#include "shared/shading.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform utextureBuffer texelStart; // first record of each, and of one more
layout(set = 0, binding = 1) uniform utextureBuffer records;    // in the order of their texels
layout(set = 0, binding = 2) uniform utextureBuffer samples;    // of each record
layout(set = 0, binding = 3) uniform textureBuffer rays;        // of each sample
layout(set = 0, binding = 4) uniform textureBuffer lights;
layout(set = 0, binding = 5, rgba32f) uniform writeonly imageBuffer sortedRays; // in the order of texels
layout(set = 0, binding = 6, rgba32f) uniform writeonly imageBuffer sortedLights;
layout(set = 0, binding = 7, r32ui) uniform writeonly uimageBuffer raysOfTexels;
layout(push_constant) uniform Push {
    ShadingPush push;
};

int sampleInTexelAt(uint i) {
    return int(texelFetch(samples, int(texelFetch(records, int(i)).x)).x);
}
vec4 rayAt(uint i) {
    return texelFetch(rays, sampleInTexelAt(i));
}
#include "lib/shadow_texels.glsl"

void main() {
    const int texel =
        int(linearInvocation(gl_WorkGroupID, gl_NumWorkGroups, gl_WorkGroupSize, gl_LocalInvocationIndex));
    if (texel >= push.size.x * push.size.y) return;
    const uint begin = texelFetch(texelStart, texel).x, end = texelFetch(texelStart, texel + 1).x;
    for (uint i = begin; i < end; ++i) {
        imageStore(sortedRays, int(i), rayAt(i));
        imageStore(sortedLights, int(i), texelFetch(lights, sampleInTexelAt(i)));
    }
    imageStore(raysOfTexels, texel, uvec4(raysBetween(begin, end)));
}

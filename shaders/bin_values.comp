#version 460
// The values of the records: those of their samples, with their radius ratios.
#extension GL_GOOGLE_include_directive : require
#include "resources/invocation.glsl"
#include "shared/reconstruct.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform utextureBuffer samples; // of each record
layout(set = 0, binding = 1) uniform textureBuffer sampleValues;
layout(set = 0, binding = 2, rgba32f) uniform imageBuffer values;
layout(push_constant) uniform Push {
    CountPush push;
};

void main() {
    const uint i =
        linearInvocation(gl_WorkGroupID, gl_NumWorkGroups, gl_WorkGroupSize, gl_LocalInvocationIndex);
    if (i >= push.count) return;
    const vec4 value = texelFetch(sampleValues, int(texelFetch(samples, int(i)).x));
    imageStore(values, int(i), vec4(value.rgb, imageLoad(values, int(i)).w));
}

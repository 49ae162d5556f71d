#version 460
// Other radiances for the records, as the samples have them.
#extension GL_GOOGLE_include_directive : require
#include "resources/invocation.glsl"
#include "shared/reconstruct.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform utextureBuffer samples; // of each record
layout(set = 0, binding = 1) uniform textureBuffer sampleRadiances;
layout(set = 0, binding = 2, rgba32f) uniform imageBuffer radiances;
layout(push_constant) uniform Push { CountPush push; };

void main() {
    const uint i = linearInvocation(gl_WorkGroupID, gl_NumWorkGroups, gl_WorkGroupSize, gl_LocalInvocationIndex);
    if (i >= push.count) return;
    const vec4 radiance = texelFetch(sampleRadiances, int(texelFetch(samples, int(i)).x));
    imageStore(radiances, int(i), vec4(radiance.rgb, imageLoad(radiances, int(i)).w));
}

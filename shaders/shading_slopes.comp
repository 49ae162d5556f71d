#version 460
// How the nearness of each surfel changes per pixel along x and y.
#extension GL_GOOGLE_include_directive : require
#include "resources/invocation.glsl"
#include "shared/shading.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform textureBuffer geometry;
layout(set = 0, binding = 1, rgba32f) uniform writeonly imageBuffer slopes;
layout(push_constant) uniform Push {
    ShadingPush push;
};

vec4 geometryAt(int surfel) {
    return texelFetch(geometry, surfel);
}
#include "lib/shading_slopes.glsl"

void main() {
    const int surfel =
        int(linearInvocation(gl_WorkGroupID, gl_NumWorkGroups, gl_WorkGroupSize, gl_LocalInvocationIndex));
    if (surfel >= push.size.x * push.size.y * kSurfels || !(geometryAt(surfel).w > 0.0)) return;
    imageStore(slopes, surfel,
               vec4(slopeAlong(surfel, push.size, ivec2(1, 0)), slopeAlong(surfel, push.size, ivec2(0, 1)),
                    0.0, 0.0));
}

#version 460
// The bricks of the sorted entries.
#extension GL_GOOGLE_include_directive : require
#include "lib/invocation.glsl"
#include "shared/reconstruct.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform utextureBuffer ids;
layout(set = 0, binding = 1) uniform utextureBuffer bricks;
layout(set = 0, binding = 2, rgba32ui) uniform writeonly uimageBuffer listBricks;
layout(push_constant) uniform Push { OutputPush push; };

void main() {
    const uint i = linearInvocation(gl_WorkGroupID, gl_NumWorkGroups, gl_WorkGroupSize, gl_LocalInvocationIndex);
    if (i < push.count) imageStore(listBricks, int(i), texelFetch(bricks, int(texelFetch(ids, int(i)).x)));
}

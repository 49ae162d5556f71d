#version 460
// Where each tile's list begins among the sorted entries.
#extension GL_GOOGLE_include_directive : require
#include "resources/invocation.glsl"
#include "shared/reconstruct.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform utextureBuffer lists;
layout(set = 0, binding = 1, r32ui) uniform writeonly uimageBuffer listStart;
layout(push_constant) uniform Push {
    LowerBoundPush push;
};

uint keyAt(uint i) {
    return texelFetch(lists, int(i)).x;
}
#include "lib/lower_bound.glsl"

void main() {
    const uint i =
        linearInvocation(gl_WorkGroupID, gl_NumWorkGroups, gl_WorkGroupSize, gl_LocalInvocationIndex);
    if (i < push.count) imageStore(listStart, int(i), uvec4(lowerBound(i, 0u, push.keyCount)));
}

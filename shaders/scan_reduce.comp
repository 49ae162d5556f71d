#version 460
// The sum of each chunk of items.
#extension GL_GOOGLE_include_directive : require
#include "resources/invocation.glsl"
#include "shared/scan.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform utextureBuffer items;
layout(set = 0, binding = 1, r32ui) uniform writeonly uimageBuffer sums;
layout(push_constant) uniform Push {
    ScanPush push;
};

void main() {
    const uint chunk =
        linearInvocation(gl_WorkGroupID, gl_NumWorkGroups, gl_WorkGroupSize, gl_LocalInvocationIndex);
    const uint count = push.count;
    const uint first = chunk * kScanChunk;
    if (first >= count) return;
    const uint end = min(first + kScanChunk, count);
    uint sum = 0u;
    for (uint i = first; i < end; ++i) sum += texelFetch(items, int(i)).x;
    imageStore(sums, int(chunk), uvec4(sum));
}

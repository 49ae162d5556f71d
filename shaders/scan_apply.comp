#version 460
// Replaces each item by the sum of those before it: in its chunk, and in all chunks before that (offsets).
#extension GL_GOOGLE_include_directive : require
#include "resources/invocation.glsl"
#include "shared/scan.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform utextureBuffer offsets;
layout(set = 0, binding = 1) uniform utextureBuffer itemsBefore;
layout(set = 0, binding = 2, r32ui) uniform writeonly uimageBuffer itemsAfter; // the same buffer
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
    uint sum = push.hasOffsets != 0u ? texelFetch(offsets, int(chunk)).x : 0u;
    for (uint i = first; i < end; ++i) {
        const uint item = texelFetch(itemsBefore, int(i)).x;
        imageStore(itemsAfter, int(i), uvec4(sum));
        sum += item;
    }
}

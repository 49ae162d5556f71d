#version 460
// How often each digit occurs in each chunk of keys, digit by digit: histogram[digit * chunks + chunk].
#extension GL_GOOGLE_include_directive : require
#include "lib/digit_counts.glsl"
#include "resources/invocation.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform utextureBuffer keys;
layout(set = 0, binding = 1, r32ui) uniform writeonly uimageBuffer histogram;
layout(push_constant) uniform Push {
    RadixPush push;
};

void main() {
    const uint chunk =
        linearInvocation(gl_WorkGroupID, gl_NumWorkGroups, gl_WorkGroupSize, gl_LocalInvocationIndex);
    const uint chunks = push.chunks, shift = push.shift, mask = push.mask;
    if (chunk >= chunks) return;
    const uint first = chunk * kRadixChunk;
    const uint end = min(first + kRadixChunk, push.count);
    DigitCounts counts = noDigits();
    for (uint i = first; i < end; ++i) addDigit(counts, texelFetch(keys, int(i)).x >> shift & mask);
    for (uint digit = 0u; digit < kRadixDigits; ++digit)
        imageStore(histogram, int(digit * chunks + chunk), uvec4(countOf(counts, digit)));
}

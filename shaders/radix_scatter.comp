#version 460
// Moves each pair to its place: behind all pairs of lower digits, all of its digit in earlier chunks (both in
// offsets, the scanned histogram), and those of its digit before it in its own chunk. Equal digits keep their
// order.
#extension GL_GOOGLE_include_directive : require
#include "lib/digit_counts.glsl"
#include "resources/invocation.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform utextureBuffer keysBefore;
layout(set = 0, binding = 1) uniform utextureBuffer valuesBefore;
layout(set = 0, binding = 2) uniform utextureBuffer offsets;
layout(set = 0, binding = 3, r32ui) uniform writeonly uimageBuffer keysAfter;
layout(set = 0, binding = 4, r32ui) uniform writeonly uimageBuffer valuesAfter;
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
    for (uint i = first; i < end; ++i) {
        const uint key = texelFetch(keysBefore, int(i)).x;
        const uint digit = key >> shift & mask;
        const uint place = texelFetch(offsets, int(digit * chunks + chunk)).x + countOf(counts, digit);
        addDigit(counts, digit);
        imageStore(keysAfter, int(place), uvec4(key));
        imageStore(valuesAfter, int(place), texelFetch(valuesBefore, int(i)));
    }
}

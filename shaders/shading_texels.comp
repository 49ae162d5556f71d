#version 460
// The texel of pinhole position of each record, to sort records by.
#extension GL_GOOGLE_include_directive : require
#include "lib/shading.glsl"
#include "resources/invocation.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform textureBuffer positions; // of each record: p.x, p.y
layout(set = 0, binding = 1, r32ui) uniform writeonly uimageBuffer keys;
layout(set = 0, binding = 2, r32ui) uniform writeonly uimageBuffer records;
layout(push_constant) uniform Push {
    TexelPush push;
};

void main() {
    const uint record =
        linearInvocation(gl_WorkGroupID, gl_NumWorkGroups, gl_WorkGroupSize, gl_LocalInvocationIndex);
    if (record >= push.count) return;
    imageStore(keys, int(record), uvec4(texelOf(push.texels, texelFetch(positions, int(record)).xy)));
    imageStore(records, int(record), uvec4(record));
}

#version 460
// The records and bricks of another focus: all slopes change by the same amount.
#extension GL_GOOGLE_include_directive : require
#include "resources/invocation.glsl"
#include "shared/reconstruct.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform textureBuffer tracedPositions;
layout(set = 0, binding = 1) uniform utextureBuffer tracedBricks;
layout(set = 0, binding = 2, rgba32f) uniform writeonly imageBuffer positions;
layout(set = 0, binding = 3, rgba32ui) uniform writeonly uimageBuffer bricks;
layout(push_constant) uniform Push {
    RefocusPush push;
};

uint shifted(uint slope) {
    return floatBitsToUint(uintBitsToFloat(slope) + push.slopeShift);
}

void main() {
    const uint i =
        linearInvocation(gl_WorkGroupID, gl_NumWorkGroups, gl_WorkGroupSize, gl_LocalInvocationIndex);
    if (i < push.recordCount) {
        const vec4 position = texelFetch(tracedPositions, int(i));
        imageStore(positions, int(i), vec4(position.xy, position.z + push.slopeShift, position.w));
    }
    if (i < push.brickCount) {
        const uvec4 brick = texelFetch(tracedBricks, int(i));
        imageStore(bricks, int(i), uvec4(brick.xy, shifted(brick.z), shifted(brick.w)));
    }
}

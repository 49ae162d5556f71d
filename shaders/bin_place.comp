#version 460
// Pinhole position, radius ratio and sort key of each uploaded sample.
#extension GL_GOOGLE_include_directive : require
#include "lib/grid.glsl"
#include "resources/invocation.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform textureBuffer samples; // two texels per sample: LightFieldSample
layout(set = 0, binding = 1, rgba32f) uniform writeonly imageBuffer positions;
layout(set = 0, binding = 2, r32ui) uniform writeonly uimageBuffer keys;
layout(set = 0, binding = 3, r32ui) uniform writeonly uimageBuffer indices;
layout(set = 0, binding = 4) uniform utextureBuffer pixelSums;
layout(push_constant) uniform Push {
    BinPush push;
};

uint sumAt(uint i) {
    return texelFetch(pixelSums, int(i)).x;
}
#include "lib/density.glsl"

void main() {
    const uint i =
        linearInvocation(gl_WorkGroupID, gl_NumWorkGroups, gl_WorkGroupSize, gl_LocalInvocationIndex);
    if (i >= push.count) return;
    const vec4 place = texelFetch(samples, int(2u * i));
    const Trajectory trajectory = trajectoryOf(place.xy, place.zw, texelFetch(samples, int(2u * i + 1u)).z);
    const vec2 p = trajectory.pinhole;
    const float slope = trajectory.slope;
    const int index = int(push.firstSample + i);
    const bool kept = reaches(trajectory, vec2(push.regionMin), vec2(push.regionMax), push.marginPx);
    const float radiusRatio = kept ? radiusRatioAt(push.density, p, slope, push.grid.radiusPx) : 1.0;
    imageStore(positions, index, vec4(p, slope, radiusRatio));
    imageStore(keys, index, uvec4(kept ? sortKey(push.grid, p, slope) : kNotBinned));
    imageStore(indices, index, uvec4(uint(index)));
}

#version 460
// Pinhole position, radiance, own radius and sort key of each uploaded sample.
#extension GL_GOOGLE_include_directive : require
#include "lib/grid.glsl"
#include "resources/invocation.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform textureBuffer samples; // three texels a sample: LightFieldSample
layout(set = 0, binding = 1, rgba32f) uniform writeonly imageBuffer positions;
layout(set = 0, binding = 2, rgba32f) uniform writeonly imageBuffer radiances;
layout(set = 0, binding = 3, r32ui) uniform writeonly uimageBuffer keys;
layout(set = 0, binding = 4, r32ui) uniform writeonly uimageBuffer indices;
layout(set = 0, binding = 5) uniform utextureBuffer pixelSums;
layout(push_constant) uniform Push { BinPush push; };

uint sumAt(uint i) { return texelFetch(pixelSums, int(i)).x; }
#include "lib/density.glsl"

void main() {
    const uint i = linearInvocation(gl_WorkGroupID, gl_NumWorkGroups, gl_WorkGroupSize, gl_LocalInvocationIndex);
    if (i >= push.count) return;
    const vec4 place = texelFetch(samples, int(3u * i));
    const vec4 depth = texelFetch(samples, int(3u * i + 1u));
    const vec4 radiance = texelFetch(samples, int(3u * i + 2u));
    const Trajectory trajectory = trajectoryOf(place.xy, place.zw, depth.z);
    const vec2 p = trajectory.pinhole;
    const float slope = trajectory.slope;
    const int index = int(push.firstSample + i);
    const bool kept = reaches(trajectory, vec2(push.regionMin), vec2(push.regionMax), push.marginPx);
    imageStore(positions, index, vec4(p, slope, radiance.w));
    const float radiusRatio = kept ? radiusRatioAt(push.density, p, slope, push.grid.radiusPx) : 1.0;
    imageStore(radiances, index, vec4(radiance.rgb, radiusRatio));
    imageStore(keys, index, uvec4(kept ? sortKey(push.grid, p, slope) : kNotBinned));
    imageStore(indices, index, uvec4(uint(index)));
}

// How much of the lens a sample is visible from. As host/reconstruct/occlusion.cpp, where it is explained.
#ifndef SLANT_LIB_OCCLUSION_GLSL
#define SLANT_LIB_OCCLUSION_GLSL
#include "lib/hash.glsl"
#include "shared/reconstruct.h"

/// One ray in `stride`, chosen by its place, so that the order of samples does not matter.
bool isFollowed(OcclusionLayout layout_, vec2 xy) {
    return hash(floatBitsToUint(xy.x) ^ hash(floatBitsToUint(xy.y))) % layout_.stride == 0u;
}

int firstPlaneBehind(OcclusionLayout layout_, float slope, float surfaceGap) {
    const float steps = floor((slope + surfaceGap - layout_.slopeMin) / layout_.spacing) + 1.0;
    return int(clamp(steps, 0.0, float(layout_.planeCount)));
}

float planeSlope(OcclusionLayout layout_, int plane) {
    return layout_.slopeMin + (float(plane) + 0.5) * layout_.spacing;
}

/// The block of a plane that a ray crosses at p, and -1 where it crosses none.
int blockCrossed(OcclusionLayout layout_, int plane, vec2 p, vec2 origin) {
    const vec2 place = floor((p - origin) * layout_.invBlock);
    const ivec2 blocks = layout_.blockCount;
    if (place.x < 0.0 || place.y < 0.0 || place.x >= float(blocks.x) || place.y >= float(blocks.y)) return -1;
    return (plane * blocks.y + int(place.y)) * blocks.x + int(place.x);
}

/// The block that a sample lies in.
int blockOf(OcclusionLayout layout_, vec2 p, float slope, vec2 origin) {
    const vec2 place = floor((p - origin) * layout_.invBlock);
    const ivec2 block = ivec2(clamp(place, vec2(0.0), vec2(layout_.blockCount - 1)));
    const float steps = floor((slope - layout_.slopeMin) / layout_.spacing);
    const int plane = int(clamp(steps, 0.0, float(layout_.planeCount - 1)));
    return (plane * layout_.blockCount.y + block.y) * layout_.blockCount.x + block.x;
}

float visibilityWeight(OcclusionLayout layout_, uint stopped, float radiusRatio) {
    const float rays = layout_.raysPerBlock * (radiusRatio * radiusRatio);
    return 1.0 / max(1.0 - float(stopped) / rays, kMinVisible);
}
#endif

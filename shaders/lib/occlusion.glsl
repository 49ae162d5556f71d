// From how much of the lens a sample is visible, which host/reconstruct/occlusion.h explains.
#ifndef SLANT_LIB_OCCLUSION_GLSL
#define SLANT_LIB_OCCLUSION_GLSL
#include "lib/hash.glsl"
#include "shared/reconstruct.h"

SLANT_SHARED_BEGIN

/// One ray in `stride`, chosen by its place, so that the order of samples does not matter.
KERNEL bool isFollowed(IN(OcclusionLayout) layout_, vec2 xy) {
    return hash(floatBitsToUint(xy.x) ^ hash(floatBitsToUint(xy.y))) % layout_.stride == 0u;
}

/// The first plane that lies behind a sample's surface.
KERNEL int firstPlaneBehind(IN(OcclusionLayout) layout_, float slope, float surfaceGap) {
    const float steps = floor((slope + surfaceGap - layout_.slopeMin) / layout_.spacing) + 1.0f;
    return int(clamp(steps, 0.0f, float(layout_.planeCount)));
}

KERNEL float planeSlope(IN(OcclusionLayout) layout_, int plane) {
    return layout_.slopeMin + (float(plane) + 0.5f) * layout_.spacing;
}

/// The block of a plane that a ray crosses at p, and -1 where it crosses none.
KERNEL int blockCrossed(IN(OcclusionLayout) layout_, int plane, vec2 p, vec2 origin) {
    const vec2 place = floor((p - origin) * layout_.invBlock);
    const ivec2 blocks = layout_.blockCount;
    if (place.x < 0.0f || place.y < 0.0f || place.x >= float(blocks.x) || place.y >= float(blocks.y))
        return -1;
    return (plane * blocks.y + int(place.y)) * blocks.x + int(place.x);
}

/// The block that a sample lies in.
KERNEL int blockOf(IN(OcclusionLayout) layout_, vec2 p, float slope, vec2 origin) {
    const vec2 place = floor((p - origin) * layout_.invBlock);
    const ivec2 block = ivec2(clamp(place, vec2(0.0f), vec2(layout_.blockCount - 1)));
    const float steps = floor((slope - layout_.slopeMin) / layout_.spacing);
    const int plane = int(clamp(steps, 0.0f, float(layout_.planeCount - 1)));
    return (plane * layout_.blockCount.y + block.y) * layout_.blockCount.x + block.x;
}

/// 1 / (part of the lens from which a sample is visible), at most 1 / kMinVisible; of its block's rays
/// `stopped` end before they get there, `radiusRatio` as radiusRatioAt.
KERNEL float visibilityWeight(IN(OcclusionLayout) layout_, uint stopped, float radiusRatio) {
    const float rays = layout_.raysPerBlock * (radiusRatio * radiusRatio);
    return 1.0f / max(1.0f - float(stopped) / rays, kMinVisible);
}

SLANT_SHARED_END
#endif

// From how much of the lens a sample is visible, which host/reconstruct/occlusion.h explains.
#ifndef SLANT_LIB_OCCLUSION_GLSL
#define SLANT_LIB_OCCLUSION_GLSL
#include "lib/hash.glsl"
#include "lib/motion.glsl"
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

/// Part of the lens from which a sample is visible; of its block's rays `stopped` end before they get there,
/// `radiusRatio` as radiusRatioAt. Below 0 by chance.
KERNEL float visiblePart(IN(OcclusionLayout) layout_, uint stopped, float radiusRatio) {
    const float rays = layout_.raysPerBlock * (radiusRatio * radiusRatio);
    return 1.0f - float(stopped) / rays;
}

/// 1 / that, at most 1 / kMinVisible.
KERNEL float visibilityWeight(IN(OcclusionLayout) layout_, uint stopped, float radiusRatio) {
    return 1.0f / max(visiblePart(layout_, stopped, radiusRatio), kMinVisible);
}

/// Blocks of one slot of time; where things move, each slot has its own.
KERNEL int blocksPerSlot(IN(OcclusionLayout) layout_) {
    return layout_.planeCount * layout_.blockCount.y * layout_.blockCount.x;
}
KERNEL int slotAt(IN(MotionLayout) motion, float t) {
    return int(clamp(floor(t * motion.timeSlots), 0.0f, motion.timeSlots - 1.0f));
}
/// Of a plane of ranks, where things move.
KERNEL float slopeOfPlane(IN(OcclusionLayout) layout_, IN(MotionLayout) motion, int plane) {
    return motion.c2 + motion.slopePerRank * planeSlope(layout_, plane);
}

SLANT_SHARED_END
#endif

// From how much of lens and shutter a sample that moves is visible (host/reconstruct/occlusion.h).
//
// Needs, declared before the include: stoppedAt(int), which reads how many rays end before each block. In C++
// it is included in a struct that has that, after lib/occlusion.glsl.
#include "lib/occlusion.glsl"

/// 1 / the mean, over the shutter, of the part of the lens that sees the point; as visibilityWeight.
KERNEL float movingVisibilityWeight(IN(OcclusionLayout) layout_, IN(MotionLayout) motion,
                                    IN(MovingPoint) point, float rank, vec2 origin, float radiusRatio) {
    const int slots = int(motion.timeSlots);
    float sum = 0.0f;
    for (int slot = 0; slot < slots; ++slot) {
        const float time = (float(slot) + 0.5f) / motion.timeSlots - 0.5f;
        const vec2 p = atTime(point.trajectory, point.motion, time).pinhole;
        const int block = blockOf(layout_, p, rankAt(rank, point.motion.depthRate, time), origin);
        sum += visiblePart(layout_, stoppedAt(slot * blocksPerSlot(layout_) + block), radiusRatio);
    }
    return 1.0f / max(sum / motion.timeSlots, kMinVisible);
}

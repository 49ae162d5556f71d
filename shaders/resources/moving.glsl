// Whether anything moves in the field (lib/motion.glsl).
#ifndef SLANT_RESOURCES_MOVING_GLSL
#define SLANT_RESOURCES_MOVING_GLSL
#include "lib/motion.glsl"

layout(constant_id = 1) const bool kMoving = false;

/// In passes that bind it as `motionTexels`.
#define READ_MOTION_LAYOUT                                                                                   \
    motionLayoutOf(texelFetch(motionTexels, 0), texelFetch(motionTexels, 1), texelFetch(motionTexels, 2),    \
                   texelFetch(motionTexels, 3))

/// From its texels.
MotionLayout motionLayoutOf(vec4 a, vec4 b, vec4 c, vec4 d) {
    return MotionLayout(a.x, a.y, a.z, a.w, b.x, b.y, b.z, b.w, c.xy, c.z, c.w, d.xy, d.z, d.w);
}
BrickMotion brickMotionOf(vec4 a, vec4 b) {
    return BrickMotion(a.xy, a.zw, b.xy, b.zw);
}
#endif

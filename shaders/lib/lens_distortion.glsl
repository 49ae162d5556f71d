// Where the film has what a compound lens sees through the middle of its entrance pupil
// (host/camera/lens_distortion.h).
//
// Needs, declared before the include: distortionAt(int), which reads the texels; and distortionHead, the
// first of them. In C++ it is included in a struct that has these.
#include "shared/kernel.h"
#include "shared/lens_map.h"

/// Of a pinhole position.
KERNEL vec2 distorted(vec2 pinhole) {
    const vec2 offset = pinhole - vec2(distortionHead);
    const float r = sqrt(offset.x * offset.x + offset.y * offset.y);
    const float place = distortionHead.w - distortionHead.w * (distortionHead.z / (r + distortionHead.z));
    const int i = int(place);
    IN(vec4) ratio = distortionAt(1 + i);
    return vec2(distortionHead) + (ratio.x + (place - float(i)) * ratio.y) * offset;
}

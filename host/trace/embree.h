// The one place that includes Embree: hides the differences between versions 3 and 4. Rays are not declared
// coherent: that gains little for packets of 16, and Embree 3.13 then hangs in occlusion tests of instances.
#pragma once
#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace slant::embree {

#if RTC_VERSION_MAJOR >= 4

inline void intersect(RTCScene scene, RTCRayHit& ray) {
    rtcIntersect1(scene, &ray);
}
inline void intersect(RTCScene scene, const int* valid, RTCRayHit16& rays) {
    rtcIntersect16(valid, scene, &rays);
}
inline void occluded(RTCScene scene, RTCRay& ray) {
    rtcOccluded1(scene, &ray);
}
inline void occluded(RTCScene scene, const int* valid, RTCRay16& rays) {
    rtcOccluded16(valid, scene, &rays);
}

#else

inline RTCIntersectContext newContext() {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    return context;
}

inline void intersect(RTCScene scene, RTCRayHit& ray) {
    RTCIntersectContext context = newContext();
    rtcIntersect1(scene, &context, &ray);
}

inline void intersect(RTCScene scene, const int* valid, RTCRayHit16& rays) {
    RTCIntersectContext context = newContext();
    rtcIntersect16(valid, scene, &context, &rays);
}

inline void occluded(RTCScene scene, RTCRay& ray) {
    RTCIntersectContext context = newContext();
    rtcOccluded1(scene, &context, &ray);
}

inline void occluded(RTCScene scene, const int* valid, RTCRay16& rays) {
    RTCIntersectContext context = newContext();
    rtcOccluded16(valid, scene, &context, &rays);
}

#endif

} // namespace slant::embree

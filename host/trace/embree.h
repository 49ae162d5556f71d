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

using Context = RTCRayQueryContext;

inline void searchInside(RTCScene scene, Context* context, RTCRayHit& ray) {
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.context = context;
    rtcIntersect1(scene, &ray, &arguments);
}
inline void searchInside(RTCScene scene, Context* context, RTCRay& ray) {
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    arguments.context = context;
    rtcOccluded1(scene, &ray, &arguments);
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

using Context = RTCIntersectContext;

inline void searchInside(RTCScene scene, Context* context, RTCRayHit& ray) {
    rtcIntersect1(scene, context, &ray);
}
inline void searchInside(RTCScene scene, Context* context, RTCRay& ray) {
    rtcOccluded1(scene, context, &ray);
}

#endif

/// Goes on with a ray in another scene, from within a callback: the nearest hit (RTCRayHit) or any (RTCRay).
/// Hits there carry `instance` as their instID.
template <typename Query>
void searchInside(RTCScene scene, Context* context, unsigned instance, Query& ray) {
    context->instID[0] = instance;
    searchInside(scene, context, ray);
    context->instID[0] = RTC_INVALID_GEOMETRY_ID;
}

} // namespace slant::embree

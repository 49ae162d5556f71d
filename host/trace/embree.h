// The one place that includes Embree: hides the differences between versions 3 and 4.
#pragma once
#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace slant::embree {

enum class Coherence { coherent, incoherent };

#if RTC_VERSION_MAJOR >= 4

template <typename Arguments>
void setCoherence(Arguments& arguments, Coherence coherence) {
    arguments.flags =
        coherence == Coherence::coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
}

inline RTCIntersectArguments intersectArguments(Coherence coherence) {
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    setCoherence(arguments, coherence);
    return arguments;
}

inline RTCOccludedArguments occludedArguments(Coherence coherence) {
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    setCoherence(arguments, coherence);
    return arguments;
}

inline void intersect(RTCScene scene, RTCRayHit& ray, Coherence coherence) {
    RTCIntersectArguments arguments = intersectArguments(coherence);
    rtcIntersect1(scene, &ray, &arguments);
}

inline void intersect(RTCScene scene, const int* valid, RTCRayHit16& rays, Coherence coherence) {
    RTCIntersectArguments arguments = intersectArguments(coherence);
    rtcIntersect16(valid, scene, &rays, &arguments);
}

inline void occluded(RTCScene scene, RTCRay& ray, Coherence coherence) {
    RTCOccludedArguments arguments = occludedArguments(coherence);
    rtcOccluded1(scene, &ray, &arguments);
}

inline void occluded(RTCScene scene, const int* valid, RTCRay16& rays, Coherence coherence) {
    RTCOccludedArguments arguments = occludedArguments(coherence);
    rtcOccluded16(valid, scene, &rays, &arguments);
}

#else

inline RTCIntersectContext context(Coherence coherence) {
    RTCIntersectContext result;
    rtcInitIntersectContext(&result);
    result.flags = coherence == Coherence::coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT
                                                    : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    return result;
}

inline void intersect(RTCScene scene, RTCRayHit& ray, Coherence coherence) {
    RTCIntersectContext c = context(coherence);
    rtcIntersect1(scene, &c, &ray);
}

inline void intersect(RTCScene scene, const int* valid, RTCRayHit16& rays, Coherence coherence) {
    RTCIntersectContext c = context(coherence);
    rtcIntersect16(valid, scene, &c, &rays);
}

inline void occluded(RTCScene scene, RTCRay& ray, Coherence coherence) {
    RTCIntersectContext c = context(coherence);
    rtcOccluded1(scene, &c, &ray);
}

inline void occluded(RTCScene scene, const int* valid, RTCRay16& rays, Coherence coherence) {
    RTCIntersectContext c = context(coherence);
    rtcOccluded16(valid, scene, &c, &rays);
}

#endif

} // namespace slant::embree

// Embree 3 and 4 behind one spelling; CMake says which was found. The two differ in the last argument of a query.
#pragma once

#if GRANDSTAND_EMBREE >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace pointsample {

// Afterwards ray.tfar is negative if anything was in the way.
inline void occluded(RTCScene scene, RTCRay& ray) {
#if GRANDSTAND_EMBREE >= 4
    rtcOccluded1(scene, &ray, nullptr);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(scene, &context, &ray);
#endif
}

// The same for eight rays; lanes whose `valid` is 0 are left alone.
inline void occluded(RTCScene scene, const int* valid, RTCRay8& rays) {
#if GRANDSTAND_EMBREE >= 4
    rtcOccluded8(valid, scene, &rays, nullptr);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded8(valid, scene, &context, &rays);
#endif
}

}  // namespace pointsample

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

}  // namespace pointsample

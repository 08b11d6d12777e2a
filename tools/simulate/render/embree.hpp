// Embree 3 and 4 behind one interface: a scene, the nearest hit, and a count of the hairs a ray
// crosses.
#pragma once

#if PLAIT_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <Eigen/Core>

#include <cmath>
#include <limits>

namespace render {

#if PLAIT_EMBREE_MAJOR >= 4
using QueryContext = RTCRayQueryContext;
#else
using QueryContext = RTCIntersectContext;
#endif

// What a shadow ray carries through Embree to count_hair(): Embree hands back a pointer to `base`.
struct ShadowContext {
    QueryContext base;
    int hairs = 0;
    int most = 0; // stop here: what is behind so many hairs is dark
};

// The filter of the hair geometry for shadow rays: each hair is counted and let through.
inline void count_hair(const RTCFilterFunctionNArguments* hit) {
    auto* context = reinterpret_cast<ShadowContext*>(hit->context);
    if (hit->valid[0] == -1 && ++context->hairs < context->most)
        hit->valid[0] = 0;
}

inline RTCRay make_ray(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, float near,
                       float far) {
    RTCRay ray{};
    ray.org_x = origin.x(), ray.org_y = origin.y(), ray.org_z = origin.z();
    ray.dir_x = direction.x(), ray.dir_y = direction.y(), ray.dir_z = direction.z();
    ray.tnear = near;
    ray.tfar = far;
    ray.mask = ~0u;
    return ray;
}

inline RTCRayHit nearest_hit(RTCScene scene, const Eigen::Vector3f& origin,
                             const Eigen::Vector3f& direction) {
    RTCRayHit query{};
    query.ray = make_ray(origin, direction, 0.0f, std::numeric_limits<float>::infinity());
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
#if PLAIT_EMBREE_MAJOR >= 4
    rtcIntersect1(scene, &query, nullptr);
#else
    QueryContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene, &context, &query);
#endif
    return query;
}

// What lies on the ray, by the filters of the scene's geometries, to which `context` is handed.
inline void filter_along(RTCScene scene, RTCRay& ray, QueryContext& context) {
#if PLAIT_EMBREE_MAJOR >= 4
    rtcInitRayQueryContext(&context);
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    arguments.context = &context;
    rtcOccluded1(scene, &ray, &arguments);
#else
    rtcInitIntersectContext(&context);
    rtcOccluded1(scene, &context, &ray);
#endif
}

// How many hairs, at most `most`, lie on the ray; `most` as well when it meets something solid.
inline int hairs_on_ray(RTCScene scene, RTCRay ray, int most) {
    ShadowContext context;
    context.most = most;
    filter_along(scene, ray, context.base);
    return ray.tfar < 0.0f ? most : context.hairs;
}

} // namespace render

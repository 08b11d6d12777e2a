/* velocity_shock: carry free vertices from 2 on along with the root segment's rigid motion.
 *
 * Items   vertices.
 * Reads   vertex_count, strand_motion.
 * Moves   position and position_prev: p <- (1 - c) p + c (q p + t).
 * Source  TressFX 4.1, velocity shock propagation. Both are moved alike, so the velocity turns with
 *         the root but does not grow: the step's share of root motion is injected without inertia.
 * Changed pinned vertices beyond the second stay where integrate put them.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "base/quat.clh"
#include "base/strand.clh"
#include "plait/params.h"

static inline float4 propagate(quat q, float4 translation_blend, float4 element) {
    const float c = translation_blend.w;
    const vec3 p = unpack3(element);
    const vec3 carried = add3(rotate3(q, p), unpack3(translation_blend));
    return pack3(axpy3(c, carried, scale3(p, 1.0f - c)), element.w);
}

__kernel void plait_velocity_shock(const uint item_count, const plait_layout_params params,
                                   __global const uint* vertex_count,
                                   __global const float4* strand_motion, __global float4* position,
                                   __global float4* position_prev) {
    const uint item = get_global_id(0);
    if (item >= item_count)
        return;
    const uint strand = item / params.vertex_stride;
    const uint vertex = item % params.vertex_stride;
    const float4 x = position[item];
    if (vertex < 2u || vertex >= vertex_count[strand] || !is_free(x))
        return;
    const quat q = strand_motion[PLAIT_MOTION_STRIDE * (size_t)strand];
    const float4 translation_blend = strand_motion[PLAIT_MOTION_STRIDE * (size_t)strand + 1];
    position[item] = propagate(q, translation_blend, x);
    position_prev[item] = propagate(q, translation_blend, position_prev[item]);
}

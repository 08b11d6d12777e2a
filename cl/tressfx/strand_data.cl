/* strand_data: the rigid motion of the root segment over the step, and how much of it to propagate.
 *
 * Items   strands.
 * Reads   position and both histories, of vertices 0 and 1.
 * Writes  strand_motion: rotation q; translation t and blend c.
 * Source  TressFX 4.1, velocity shock propagation: q turns the root segment's previous direction to
 *         the present one, t = x0 - q prev0, a = |x1 - 2 prev1 + prev2_1|, c = 1 above a threshold,
 *         else vsp_coeff.
 * Changed PLAIT_SHOCK_CONTINUOUS: c rises linearly from vsp_coeff at the threshold to 1 at twice
 *         it. The jump lets neighbouring strands, a hair's breadth apart in a, move differently. q
 *         is the shortest rotation and safe at a half turn; a root segment of no length gives 1.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "base/quat.clh"
#include "plait/params.h"

/* `a` in metres per step squared. */
static inline float shock_blend(const plait_strand_data_params* params, float a) {
    const float excess = a - params->vsp_accel_threshold;
    if (params->shock_form == PLAIT_SHOCK_THRESHOLD || params->vsp_accel_threshold <= 0.0f)
        return excess > 0.0f ? 1.0f : params->vsp_coeff;
    const float rise = clamp(excess / params->vsp_accel_threshold, 0.0f, 1.0f);
    return params->vsp_coeff + rise * (1.0f - params->vsp_coeff);
}

__kernel void plait_strand_data(const uint item_count, const plait_strand_data_params params,
                                __global const float4* position,
                                __global const float4* position_prev,
                                __global const float4* position_prev2,
                                __global float4* strand_motion) {
    const uint strand = get_global_id(0);
    if (strand >= item_count)
        return;
    const size_t root = (size_t)strand * params.vertex_stride;
    const vec3 x0 = unpack3(position[root]), x1 = unpack3(position[root + 1]);
    const vec3 prev0 = unpack3(position_prev[root]), prev1 = unpack3(position_prev[root + 1]);
    const vec3 before1 = unpack3(position_prev2[root + 1]);
    const vec3 acceleration = add3(sub3(x1, scale3(prev1, 2.0f)), before1);
    const quat q = quat_between(sub3(prev1, prev0), sub3(x1, x0));
    const vec3 t = sub3(x0, rotate3(q, prev0));
    strand_motion[PLAIT_MOTION_STRIDE * (size_t)strand] = q;
    strand_motion[PLAIT_MOTION_STRIDE * (size_t)strand + 1] =
        pack3(t, shock_blend(&params, length3(acceleration)));
}

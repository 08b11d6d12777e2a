/* cosserat: one substep of a stable Cosserat rod.
 *
 * Items   strands, over lanes.
 * Reads   lane_strand, rest, pose, lane_material, lane_rest, collider.
 * Moves   lane_x, lane_v, lane_q, and the steps before.
 * Source  Hsu et al. 2025; Kugelstadt & Schoemer 2016. Changed: see strands/cosserat.clh and
 *         strands/rod.clh; orientations start from the rotation of the substep before, repeated
 *         (half the error of a substep at no cost), not from where they stood.
 */
#pragma OPENCL FP_CONTRACT ON
#include "strands/cosserat.clh"

__kernel void plait_cosserat(const uint item_count, const plait_lane_params params,
                             __global const uint* lane_strand, __global const float4* rest,
                             __global const float4* pose, __global const real* lane_material,
                             __global const real* lane_rest, __global const float4* collider,
                             __global const real* lane_acceleration, __global const real* lane_pin,
                             __global const real* lane_plane, __global real* lane_x,
                             __global real* lane_v, __global real* lane_q,
                             __global real* lane_q_before, __global real* lane_x_before,
                             __global real* lane_v_before) {
    HOLD_IDLE_LOCAL(item_count, lane_x)
    lane_step step;
    if (!lane_begin(&step, item_count, &params, lane_strand, rest, pose, lane_material,
                    lane_acceleration, lane_pin))
        return;
    const lane_buffers state = {lane_x, lane_v, lane_x_before, lane_v_before};
    rod_state s;
    vec3 y[PLAIT_VERTICES], w[PLAIT_VERTICES];
    lane_predict(&step, &params, state, y, w);
    lane_contacts contacts;
    contact_begin(&contacts, &step, &params, collider, lane_plane, lane_x);
    rod_factors factors;
    rod_problem rod =
        rod_problem_of(&step, y, lane_rest, contact_may_be(&params) ? &contacts : 0, &factors);
    rod.sections = 1;
    rod_load(&rod, &params, &s, lane_q, lane_q_before);

    cosserat_iterate(&rod, &s, params.iterations, 1);

    rod_store(&rod, &params, state, &s, w, lane_q, lane_q_before, PLAIT_ROD_MIN_STRAIN);
}

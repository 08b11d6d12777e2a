/* lane_reset: the lane state at the skinned rest shape, at rest.
 *
 * Items   strands, over lanes.
 * Reads   lane_strand, rest, pose, lane_rest.
 * Writes  lane_x, lane_v, lane_q, lane_q_before, and the step before where BDF2 keeps it.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "base/lane_step.clh"

__kernel PLAIT_WIDE void
plait_lane_reset(const uint item_count, const plait_lane_state_params params,
                 __global const uint* lane_strand, __global const float4* rest,
                 __global const float4* pose, __global const real* lane_rest, __global real* lane_x,
                 __global real* lane_v, __global real* lane_q, __global real* lane_q_before,
                 __global real* lane_x_before, __global real* lane_v_before,
                 __global real* lane_normal_force) {
    const lane_place place = lane_place_of(get_global_id(0));
    if (!lane_place_used(place, item_count))
        return;
    const lane_strands strands = lane_strands_of(lane_strand, place, item_count);
    const lane_pose p = lane_load_pose(rest, pose, &strands, params.row_stride);
    const vec3 origin = gather3(rest, &strands, params.row_stride, 0);
    const vec3 zero = vec3_of((real)(0.0f), (real)(0.0f), (real)(0.0f));
    quat q = p.q;
    for (int i = 0; i < (int)params.vertex_stride; ++i) {
        const vec3 offset = sub3(gather3(rest, &strands, params.row_stride, i), origin);
        const vec3 x = lane_carried(i, p.root, p.q, offset);
        store3(lane_x, place, i, x);
        store3(lane_v, place, i, zero);
        lane_normal_force[lane_index(place, 1, i, 0)] = (real)(0.0f);
        if (params.history) {
            store3(lane_x_before, place, i, x);
            store3(lane_v_before, place, i, zero);
        }
        q = mulq(q, loadq(lane_rest, place, i));
        storeq(lane_q, place, i, q);
        storeq(lane_q_before, place, i, q);
    }
}

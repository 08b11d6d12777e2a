/* lane_teleport: carry the lane state rigidly from one root pose to another, motion relative to the
 * root kept.
 *
 * Items   strands, over lanes.
 * Reads   lane_strand, rest, pose_from, pose_to.
 * Moves   lane_x, lane_v, lane_q, lane_q_before, and the step before where BDF2 keeps it.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "base/lane_step.clh"

static inline void carry(__global real* x, lane_place place, int row, vec3 root, quat turn) {
    store3(x, place, row, lane_carried(row, root, turn, load3(x, place, row)));
}

/* Where the root was a substep ago, as it moves on by the turned velocity. */
static inline vec3 root_before(__global const real* x, __global const real* x_before,
                               lane_place place, vec3 root, quat turn) {
    return add3(root, rotate3(turn, sub3(load3(x_before, place, 0), load3(x, place, 0))));
}

__kernel PLAIT_WIDE void
plait_lane_teleport(const uint item_count, const plait_lane_state_params params,
                    __global const uint* lane_strand, __global const float4* rest,
                    __global const float4* pose_from, __global const float4* pose_to,
                    __global real* lane_x, __global real* lane_v, __global real* lane_q,
                    __global real* lane_q_before, __global real* lane_x_before,
                    __global real* lane_v_before, __global real* lane_normal_force) {
    const lane_place place = lane_place_of(get_global_id(0));
    if (!lane_place_used(place, item_count))
        return;
    const lane_strands strands = lane_strands_of(lane_strand, place, item_count);
    const lane_pose from = lane_load_pose(rest, pose_from, &strands, params.row_stride);
    const lane_pose to = lane_load_pose(rest, pose_to, &strands, params.row_stride);
    const quat turn = mulq(to.q, conjq(from.q));
    vec3 before = to.root;
    if (params.history)
        before = root_before(lane_x, lane_x_before, place, to.root, turn);
    for (int i = 0; i < (int)params.vertex_stride; ++i) {
        carry(lane_x, place, i, to.root, turn);
        store3(lane_v, place, i, rotate3(turn, load3(lane_v, place, i)));
        lane_normal_force[lane_index(place, 1, i, 0)] = (real)(0.0f);
        storeq(lane_q, place, i, mulq(turn, loadq(lane_q, place, i)));
        storeq(lane_q_before, place, i, mulq(turn, loadq(lane_q_before, place, i)));
        if (params.history) {
            carry(lane_x_before, place, i, before, turn);
            store3(lane_v_before, place, i, rotate3(turn, load3(lane_v_before, place, i)));
        }
    }
}

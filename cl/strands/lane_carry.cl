/* lane_carry: carries the lane state along with a frame whose motion hair does not feel.
 *
 * Items   strands, over lanes.
 * Moves   lane_x, lane_v, lane_q, lane_q_before, and BDF2's lane_x_before, lane_v_before: the roots by
 *         p -> q*p + t, what is relative to them by q. Without a turn only the roots.
 * Source  ours.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "base/lane_step.clh"

static inline void carry_places(const plait_carry_params* params, quat turn, lane_place place,
                                __global real* x) {
    const vec3 t = vec3_of((real)(params->t[0]), (real)(params->t[1]), (real)(params->t[2]));
    const vec3 root = load3(x, place, 0);
    store3(x, place, 0, add3(params->turns ? rotate3(turn, root) : root, t));
    if (params->turns)
        for (int i = 1; i < (int)params->vertex_stride; ++i)
            store3(x, place, i, rotate3(turn, load3(x, place, i)));
}

static inline void carry_velocities(const plait_carry_params* params, quat turn, lane_place place,
                                    __global real* v) {
    for (int i = 0; i < (int)params->vertex_stride; ++i)
        store3(v, place, i, rotate3(turn, load3(v, place, i)));
}

__kernel PLAIT_WIDE void plait_lane_carry(const uint item_count, const plait_carry_params params,
                                          __global real* lane_x, __global real* lane_v,
                                          __global real* lane_q, __global real* lane_q_before,
                                          __global real* lane_x_before,
                                          __global real* lane_v_before) {
    const lane_place place = lane_place_of(get_global_id(0));
    if (!lane_place_used(place, item_count))
        return;
    const quat turn =
        quat_of((real)(params.q[0]), (real)(params.q[1]), (real)(params.q[2]), (real)(params.q[3]));
    carry_places(&params, turn, place, lane_x);
    if (params.history)
        carry_places(&params, turn, place, lane_x_before);
    if (!params.turns)
        return;
    carry_velocities(&params, turn, place, lane_v);
    if (params.history)
        carry_velocities(&params, turn, place, lane_v_before);
    for (int i = 0; i < (int)params.vertex_stride; ++i) {
        storeq(lane_q, place, i, mulq(turn, loadq(lane_q, place, i)));
        storeq(lane_q_before, place, i, mulq(turn, loadq(lane_q_before, place, i)));
    }
}

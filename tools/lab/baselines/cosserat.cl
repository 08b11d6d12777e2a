/* Baseline: a stable Cosserat rod by alternating solves.
 *
 * Source  Hsu et al. 2025; Kugelstadt & Schoemer 2016. Changed: see cosserat.clh and
 *         stretch_rod.clh; orientations start from the rotation of the substep before, repeated
 *         (half the error of a substep at no cost), not from where they stood.
 */
#pragma OPENCL FP_CONTRACT ON
#include "constants.clh"
#include "cosserat.clh"
#include "kernel.clh"

__kernel void plait_articulated(BASELINE_ARGUMENTS) {
    HOLD_IDLE_LOCAL(item_count, lane_x)
    lane_step step;
    if (!lane_begin(&step, item_count, &params, lane_strand, rest, pose, lane_material,
                    lane_acceleration, lane_pin))
        return;
    const lane_buffers state = {lane_x, lane_v, lane_x_before, lane_v_before};
    rod_state s;
    vec3 y[PLAIT_VERTICES], w[PLAIT_VERTICES];
    lane_predict(&step, &params, state, y, w);
    contact_loop contacts;
    contact_loop_begin(&contacts, &step, &params, collider, lane_plane, lane_x);
    rod_factors factors;
    rod_problem rod = rod_problem_of(&step, y, lane_rest,
                                     contact_may_be(&params) ? &contacts.contacts : 0, &factors);
    rod.sections = 1;
    rod_load(&rod, &params, &s, lane_q, lane_q_before);

    cosserat_iterate(&rod, &s, params.iterations, 1);

    rod_store(&rod, &params, state, &s, w, lane_q, lane_q_before, ROD_MIN_STRAIN);
}
